// What the scripted participant does in the page: sees what is shown, watches, and answers as a hand would.
'use strict';

const walker = {
  // What is shown; empty while an answer is on its way.
  section() {
    const id = [...document.querySelectorAll('main > section')].find((section) => !section.hidden)?.id ?? '';
    return id === 'trial' && !trial ? '' : id;
  },

  // Changes whenever the page goes on.
  mark() {
    const {sent, practised, heard} = state;
    return [
      walker.section(), sent.answers.length, practised, heard, byId('message-title').textContent
    ].join('|');
  },

  shown() {
    if (walker.section() !== 'trial') return {section: walker.section()};
    const {page, pass, number, paths} = trial.step;
    return {
      section: 'trial',
      page: page.id,
      pass: number,
      practice: Boolean(study.training) && !state.trained,
      videos: paths.map(tokenOf),
      questions: pass.questions.map((index) => study.questions[index]),
    };
  },

  // Brings all videos to their end: plays them, or only sends them the event 'ended'.
  async watch(play) {
    for (const {video} of trial.stage.screens) {
      video.muted = true;
      if (!play) video.dispatchEvent(new Event('ended'));
    }
    if (play) document.querySelector(trial.stage.screens.length > 1 ? '#all' : '.play').click();
    for (let i = 0; i < 2400 && !trial.watched; ++i) await wait(0.025);
    return trial.watched;
  },

  fields(id) {
    const field = document.querySelector(`[data-question="${id}"]`);
    return {field, radios: [...field.querySelectorAll('input[type=radio]')]};
  },

  // The value of a question in the form of the answers; null leaves it open.
  fill(question, value, reasons) {
    if (value === null) return;
    const {field, radios} = walker.fields(question.id);
    const {kind} = question;
    if (kind === 'slider') {
      const sliders = [...field.querySelectorAll('input[type=range]')];
      [value].flat().forEach((one, i) => walker.type(sliders[i], one));
    } else if (kind === 'text' || kind === 'number') {
      walker.type(field.querySelector('textarea, input'), value);
    } else if (kind === 'rank') {
      const buttons = [...field.querySelectorAll('button.rank')];
      value.map((rank, i) => [rank, i]).sort(([a], [b]) => a - b).forEach(([,
                                         i]) => buttons[i].click());
    } else if (kind === 'choice') {
      radios[question.of_videos ? value : question.options.findIndex((option) => option.id === value)]
        .click();
    } else {
      const each = [value].flat();
      each.forEach((one, i) => radios[(radios.length / each.length) * i + one - 1].click());
    }
    for (const reason of reasons) field.querySelector(`.reasons input[value="${reason}"]`).click();
  },

  type(input, value) {
    input.value = String(value);
    input.dispatchEvent(new Event('input', {bubbles: true}));
    input.dispatchEvent(new Event('change', {bubbles: true}));
  },

  // Listens, and says how many tones there were.
  async passSoundCheck() {
    await byId('tones').onclick();
    const file = study.sound_check.files.findIndex((path) => tones.src.endsWith(path));
    document.querySelectorAll('#sound-choices input')[file].click();
    byId('sound-check').click();
  },
};
