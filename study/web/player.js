// Leads a participant through a study: consent, instructions, sound check, practice, pages, questionnaire, end.
//
// The study's data is the JSON in the element "pages". Nothing is loaded from elsewhere but the videos. Answers go to the
// server that the page came from, if it has one, and are offered as a file otherwise.
'use strict';

const query = new URLSearchParams(location.search);
const participation = new Participation(query);
const {state} = participation;
const messenger = new Messenger(participation, patiently);

async function takePart() {
  if (await messenger.isDeleted()) return leave('');  // to begin anew, with the consent
  if (!(await agree())) return showDeclined();
  await messenger.begin();
  if (!state.finished) {
    await introduce();
    await checkSound();
    await practise();
    await answerPages();
    await fillQuestionnaireIn();
  } else if (messenger.online && !state.completion) {
    await messenger.finish(null);
  }
  showEnd();
}

// ---- Before the first page

async function agree() {
  if (!study.consent || state.agreed) return true;
  byId('consent-text').textContent = study.consent.text;
  byId('agree').textContent = say('agree');
  show('consent');
  const agreed = await Promise.race([
    once(byId('agree'), 'click').then(() => true),
    once(byId('decline'), 'click').then(() => false),
  ]);
  if (agreed) participation.keep({agreed: true});
  return agreed;
}

async function showDeclined() {
  const actions = linksTo(await messenger.decline());
  showMessage({title: say('declined_title'), text: say('declined'), actions});
}

// The way back for those who do not take part; none without an address.
function linksTo(address) {
  return address ? [element('a', {className: 'primary', href: address}, say('declined_link'))] : [];
}

async function introduce() {
  const pages = study.sheets[state.sent.sheet].pages.length;
  const answered = answeredPages();
  byId('instructions').textContent = study.instructions;
  const needs = [`${say('pages', {n: pages})} ${say('minutes', {n: minutes()})}`];
  if (study.sound) needs.push(say('need_sound'));
  needs.push(say('need_screen'));
  if (participation.kept) needs.push(say('need_resume'));
  byId('requirements').replaceChildren(...needs.map((text) => element('li', {}, text)));
  byId('intro-title').textContent = say(state.introduced ? 'welcome_back' : 'intro_title');
  byId('start').textContent = say(state.introduced ? 'go_on' : 'begin');
  byId('resume-note').hidden = answered === 0;
  byId('resume-note').textContent = say('answered', {n: answered, all: pages});
  loadOnly([...practiceSteps(), ...remainingSteps()].slice(0, 1).flatMap((step) => step.paths));
  show('intro');
  await once(byId('start'), 'click');
  participation.keep({introduced: true});
}

// Watching everything once, and time to think: 8 s a question.
function minutes() {
  const steps = [...practiceSteps(), ...trialSteps(state.sent.sheet)];
  const seconds = steps.reduce((sum, {page, pass, paths}) => {
    const together = !pass.sound && !oneAtATime();
    return sum + page.seconds * (together ? 1 : paths.length) + 5 + 8 * pass.questions.length;
  }, 0);
  return Math.max(1, Math.round(seconds / 60));
}

function remainingSteps() {
  return trialSteps(state.sent.sheet).slice(state.sent.answers.length);
}

// How many pages are answered in all their passes.
function answeredPages() {
  const steps = trialSteps(state.sent.sheet).slice(0, state.sent.answers.length);
  return steps.filter((step) => step.number === step.page.passes.length - 1).length;
}

// File number i has i + 1 tones; after a wrong answer another file is played.
async function checkSound() {
  if (!study.sound_check || state.heard) return;
  const {files, choices} = study.sound_check;
  let file = Math.floor(Math.random() * files.length);
  let played = null;  // the file that was heard last
  const refresh = () => {
    byId('sound-check').disabled = radios.value === null || played !== file;
  };
  const radios = new Radios(choices.map((text, value) => ({value, text})), refresh);
  const field = element('fieldset', {className: 'field cards'});
  const row = element('div', {className: 'options'});
  row.style.setProperty('--options', String(choices.length));
  row.append(...radios.inputs.map((input, i) => {
    const label = element('label');
    label.append(input, element('span', {}, choices[i]));
    return label;
  }));
  field.append(element('legend', {className: 'question'}, say('sound_question')), row);
  byId('sound-choices').replaceChildren(field);
  byId('tones').textContent = say('sound_play');
  byId('tones').onclick = async () => {
    if (await playTones(files[file])) played = file;
    refresh();
  };
  refresh();
  show('sound');
  const isRight = () => {
    if (radios.value === file) return true;
    file = (file + 1 + Math.floor(Math.random() * (files.length - 1))) % files.length;
    radios.inputs.forEach((input) => {
      input.checked = false;
    });
    refresh();
    byId('sound-problem').textContent = say('sound_wrong');
    byId('tones').focus();
    return false;
  };
  await submitted(byId('sound-form'), isRight);
  if (tones) tones.pause();
  participation.keep({heard: true});
}

let tones = null;  // what plays

// Whether they began to play.
async function playTones(path) {
  if (tones) tones.pause();
  byId('sound-problem').textContent = '';
  tones = new Audio(path);
  try {
    await tones.play();
  } catch {
    byId('sound-problem').textContent = say('sound_failed');
    return false;
  }
  byId('tones').textContent = say('sound_again');
  return true;
}

// What is answered on practice pages is not kept.
async function practise() {
  if (!study.training || state.trained) return;
  const steps = practiceSteps();
  if (state.practised === 0) {
    await read({title: say('training_title'), text: study.training.text, action: say('training_begin')});
  }
  const pages = study.training.pages.length;
  while (state.practised < steps.length) {
    const at = state.practised;
    const n = pageNumber(steps, at);
    const title = say('practice_page_of', {n, all: pages});
    showProgress(title, at / steps.length);
    byId('next').textContent = say('next');
    const [next] = [...steps, ...remainingSteps()].slice(at + 1);
    await answerTo(steps[at], {title, seed: seedOf(steps[at]), upcoming: next ? next.paths : []});
    participation.keep({practised: at + 1});
  }
  if (steps.length > 0) {
    await read({title: say('practice_over_title'), text: say('practice_over'), action: say('begin')});
  }
  participation.keep({trained: true});
}

// Shows a text until its button is pressed.
async function read({title, text, action}) {
  const button = element('button', {type: 'button', className: 'primary'}, action);
  showMessage({title, text, actions: [button]});
  await once(button, 'click');
}

function showMessage({title, text, actions = []}) {
  byId('message-title').textContent = title;
  byId('message-text').textContent = text;
  byId('message-actions').replaceChildren(...actions);
  show('message');
}

// ---- The pages

// The number of the page that a step belongs to, from 1.
function pageNumber(steps, at) {
  return steps.slice(0, at + 1).filter((step) => step.number === 0).length;
}

// Depends on the participant and the page, so that a reload shows the same.
function seedOf(step) {
  return `${study.study} ${state.sent.participant} ${step.page.id} ${step.number}`;
}

async function answerPages() {
  const steps = trialSteps(state.sent.sheet);
  const pages = study.sheets[state.sent.sheet].pages.length;
  while (state.sent.answers.length < steps.length) {
    const at = state.sent.answers.length;
    const title = say('page_of', {n: pageNumber(steps, at), all: pages});
    showProgress(title, at / steps.length);
    const last = at + 1 === steps.length && study.questionnaire.length === 0;
    byId('next').textContent = say(last ? 'finish' : 'next');
    const upcoming = at + 1 < steps.length ? steps[at + 1].paths : [];
    const entry = await answerTo(steps[at], {title, seed: seedOf(steps[at]), upcoming});
    await stored(messenger.hand(entry));
  }
  loadOnly([]);
}

function showProgress(text, share) {
  byId('progress').hidden = false;
  byId('progress-text').textContent = text;
  byId('progress-bar').value = share;
}

// Says that something is being stored, if that takes a while, and lets nothing be pressed meanwhile.
async function stored(promise) {
  byId('next').disabled = true;
  byId('skip').disabled = true;
  byId('questions').disabled = true;
  byId('saving').textContent = say('saving');
  const timer = setTimeout(() => {
    byId('saving').hidden = false;
  }, 400);
  try {
    return await promise;
  } finally {
    clearTimeout(timer);
    byId('saving').hidden = true;
  }
}

async function fillQuestionnaireIn() {
  if (state.asked || study.questionnaire.length === 0) {
    await stored(messenger.finish(state.asked ? null : {}));
    return;
  }
  const form = new QuestionForm(study.questionnaire, {changed: () => refresh()});
  const refresh = () => {
    byId('send').disabled = !form.complete;
    byId('questionnaire-problem').textContent = form.problem || (form.open > 0 ? say('open', {n: form.open}) : '');
  };
  byId('questionnaire-fields').replaceChildren(...form.elements);
  refresh();
  show('questionnaire');
  await submitted(byId('questionnaire-form'), () => form.complete);
  byId('send').disabled = true;
  await stored(messenger.finish(form.values()));
}

// ---- When the connection is lost

const kLongestWait = 30;  // between two tries [s]

// Runs `action` until the connection is not lost, and says so meanwhile.
async function patiently(action) {
  for (let tried = 0; ; ++tried) {
    try {
      const result = await action();
      byId('lost').close();
      return result;
    } catch (problem) {
      if (!(problem instanceof Lost)) {
        byId('lost').close();
        throw problem;
      }
      await nextTry(Math.max(problem.wait, Math.min(kLongestWait, 2 ** (tried + 1))));
    }
  }
}

// Waits, but not when the participant does not want to or the connection is back.
async function nextTry(seconds) {
  if (!byId('lost').open) byId('lost').showModal();
  let over = false;
  const end = () => {
    over = true;
  };
  byId('try-now').onclick = end;
  addEventListener('online', end, {once: true});
  const until = performance.now() + seconds * 1000;
  while (!over && performance.now() < until) {
    byId('lost-again').textContent = say('lost_again', {n: Math.ceil((until - performance.now()) / 1000)});
    await wait(0.2);
  }
  removeEventListener('online', end);
  byId('lost-again').textContent = say('lost_now');
}

// The server does not take what it was sent: nothing is lost, but somebody must look.
function showRefusal(problem) {
  if (problem.full) {
    showMessage({title: say('full_title'), text: say('full'), actions: linksTo(problem.url)});
    return;
  }
  const actions = state.sent.answers.length > 0 ? [saveLink()] : [];
  const error = problem.message.replace(/\.$/, '');  // the text around it has its own full stop
  showMessage({title: say('refused_title'), text: say('refused', {error}), actions});
}

// ---- The end

function saveLink(link = element('a', {className: 'primary'}, say('save'))) {
  link.href = URL.createObjectURL(new Blob([participation.text], {type: 'application/json'}));
  link.download = participation.fileName;
  return link;
}

function showEnd() {
  const {online} = messenger;
  byId('finish-text').textContent = say(online ? 'finish_stored' : 'finish_file');
  byId('file').hidden = online;
  if (!online) {
    saveLink(byId('download')).onclick = () => {
      byId('saved').textContent = say('saved', {file: participation.fileName});
    };
    byId('answer-text').value = participation.text;
  }
  const completion = (online ? state.completion : study.completion) || {};
  showCompletion(completion);
  show('finish');
  if (online && completion.url) leaveFor(completion.url);
}

function showCompletion({url, code}) {
  const {online} = messenger;
  byId('completion').hidden = !url && !code;
  byId('close').hidden = !online || Boolean(url);
  byId('completion-text').textContent = online ? '' : say('complete_once_sent');
  byId('code-row').hidden = !code;
  byId('code').textContent = code || '';
  byId('copy-code').onclick = () => navigator.clipboard.writeText(code).then(() => {
    byId('copy-code').textContent = say('copied');
  });
  byId('complete').hidden = !url;
  byId('complete').href = url || '';
}

// With a server nothing is left to do, so the page goes on by itself unless the participant stays. Readers announce the
// first count alone, and none passes while a dialog is open.
async function leaveFor(url) {
  let staying = false;
  byId('stay').hidden = false;
  byId('stay').onclick = () => {
    staying = true;
    byId('stay').hidden = true;
    byId('redirect').textContent = '';
  };
  for (let left = 10; left > 0 && !staying;) {
    byId('redirect').textContent = say('redirect', {n: left});
    await wait(1);
    byId('redirect').setAttribute('aria-live', 'off');
    if (!document.querySelector('dialog[open]')) --left;
  }
  if (!staying) location.assign(url);
}

// ---- What is stored, and withdrawing

async function showData() {
  if (trial) trial.stage.pause();
  let stored = null;
  let text = 'data_lost';
  try {
    stored = await messenger.stored();
    text = stored === null ? 'data_before' : messenger.online ? 'data_here' : 'data_device';
  } catch (problem) {
    if (!(problem instanceof Lost || problem instanceof Refused)) throw problem;
  }
  byId('data-text').textContent = say(text);
  byId('data-stored').hidden = stored === null;
  byId('data-stored').textContent = JSON.stringify(stored, null, 2);
  byId('data-sure').textContent = '';
  byId('withdraw').hidden = stored === null;
  byId('withdraw-sure').hidden = true;
  byId('data').showModal();
}

function askWhetherToWithdraw() {
  byId('data-sure').textContent = say('withdraw_sure');
  byId('data-close').focus();
  byId('withdraw').hidden = true;
  byId('withdraw-sure').hidden = false;
}

async function withdraw() {
  try {
    await messenger.withdraw();
  } catch (problem) {
    if (!(problem instanceof Lost || problem instanceof Refused)) throw problem;
    byId('data-sure').textContent = say('data_lost');
    return;
  }
  leave(messenger.online ? kWithdrawn : kWithdrawnDevice);
}

// The page is loaded again, so that nothing of the participant is left in it.
function leave(hash) {
  participation.forget();
  location.hash = hash;
  location.reload();
}

const kWithdrawn = '#withdrawn';
const kWithdrawnDevice = '#withdrawn-device';

// Whether the page shows no more than that somebody has withdrawn.
function showsWithdrawal() {
  const {hash} = location;
  if (hash !== kWithdrawn && hash !== kWithdrawnDevice) return false;
  history.replaceState(null, '', location.pathname + location.search);  // a reload begins anew
  showMessage({title: say('withdrawn_title'), text: say(hash === kWithdrawn ? 'withdrawn' : 'withdrawn_device')});
  return true;
}

function offerData() {
  byId('your-data').hidden = false;
  byId('your-data').addEventListener('click', showData);
  byId('withdraw').addEventListener('click', askWhetherToWithdraw);
  byId('withdraw-sure').addEventListener('click', withdraw);
  byId('data-close').addEventListener('click', () => byId('data').close());
}

// ---- Begin

function speak() {
  const rightToLeft = ['ar', 'fa', 'he', 'ur'].includes(study.language.split('-')[0].toLowerCase());
  document.documentElement.lang = study.language;
  document.documentElement.dir = rightToLeft ? 'rtl' : 'ltr';
  byId('shortcuts').setAttribute('aria-label', say('keys_label'));
  for (const one of document.querySelectorAll('[data-say]')) one.textContent = say(one.dataset.say);
  for (const one of document.querySelectorAll('[data-say-label]')) one.setAttribute('aria-label', say(one.dataset.sayLabel));
}

async function begin() {
  speak();
  if (showsWithdrawal()) return;
  offerData();
  watchWindow();
  byId('lost').addEventListener('cancel', (event) => event.preventDefault());
  document.addEventListener('submit', (event) => event.preventDefault());  // no form leaves the page
  addEventListener('beforeunload', (event) => {
    if (!participation.kept && !state.finished) event.preventDefault();
  });
  try {
    await takePart();
  } catch (problem) {
    if (problem instanceof Overtaken) location.reload();  // goes on where the other window is
    else if (!(problem instanceof Refused)) throw problem;
    else if (isOfNobody(problem)) leave(kWithdrawn);
    else showRefusal(problem);
  }
}

begin();
