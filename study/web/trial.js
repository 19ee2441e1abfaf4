// One page of the study: its videos, its questions, and the room that they share.
'use strict';

// ---- What is shown

// A page is shown once for each pass: [{page, pass, number of the pass, paths from left to right}].
function stepsOf(index, order) {
  const page = study.pages[index];
  return page.passes.map((pass, number) => ({page, pass, number, paths: order.map((at) => page.videos[at])}));
}

function trialSteps(sheet) {
  return study.sheets[sheet].pages.flatMap(([index, order]) => stepsOf(index, order));
}

function practiceSteps() {
  const indices = (study.training || {}).pages || [];
  return indices.flatMap((index) => stepsOf(index, study.pages[index].videos.map((_, at) => at)));
}

// What participants call the figures, from left to right.
function namesOf(videos) {
  const letters = (count) => Array.from({length: count}, (_, i) => say(`video_${i + 1}`));
  if (study.layout === 'triplet') return [say('video_1'), say('reference'), say('video_2')];
  if (study.layout === 'pair') return letters(2);  // of one video that shows both, too
  return videos === 1 ? [say('video')] : letters(videos);
}

// "clips/77.mp4" -> "77"
function tokenOf(path) {
  return path.replace(/^.*\/|\.[^.]*$/g, '');
}

const oneAtATime = () => study.layout === 'parallel' || Boolean(study.one_by_one);

// ---- The page that is shown

class Trial {
  constructor(step, seed) {
    this.step = step;
    this.began = performance.now();  // [ms]
    this.events = [];                // [seconds since then, what happened]
    this.places = [];                // lines of questions about one video: [element, place]
    const names = namesOf(step.paths.length);
    this.stage = new Stage({
      paths: step.paths,
      names,
      sound: study.sound && step.pass.sound,
      oneAtATime: study.layout === 'parallel',
      fixedOrder: Boolean(study.one_by_one),
      note: (what) => this.note(what),
      changed: () => this.refresh(),
    });
    this.form = this.makeForm(seed);
    this.build();
  }

  makeForm(seed) {
    return new QuestionForm(this.step.pass.questions.map((index) => study.questions[index]), {
      names: namesOf(this.step.paths.length),
      seed: study.shuffle_questions ? seed : null,
      changed: () => this.refresh(),
      place: (line, place) => this.tie(line, place),
    });
  }

  // Marks the line of the video that is visible; its name shows the video.
  tie(line, place) {
    this.places.push([line, place]);
    if (!this.stage.oneAtATime) return;
    const head = line.querySelector('.text');
    const button = element('button', {type: 'button', className: 'tab'}, head.textContent);
    button.addEventListener('click', () => this.stage.choose(place));
    button.setAttribute('aria-label', say('play_video', {name: head.textContent}));
    head.replaceChildren(button);
  }

  build() {
    const {page, pass} = this.step;
    byId('stage').replaceChildren(...this.stage.screens.map((screen) => screen.figure));
    byId('stage').style.setProperty('--columns', String(this.stage.oneAtATime ? 1 : this.stage.screens.length));
    byId('tabs').replaceChildren(...this.stage.tabs);
    byId('tabs').hidden = this.stage.tabs.length === 0;
    byId('caption').textContent = page.caption;
    byId('pass').hidden = page.passes.length === 1;
    byId('pass').textContent = say(pass.sound ? 'pass_sound' : 'pass_silent');
    byId('all').hidden = this.stage.screens.length === 1;
    byId('all').textContent = this.stage.playAllText;
    byId('questions').replaceChildren(...this.form.elements);
    byId('keys').hidden = false;
    byId('keys-text').replaceChildren(...this.keyHelp());
    this.refresh();
  }

  keyHelp() {
    const key = (text) => element('kbd', {}, text);
    const most = this.form.digits;
    const parts = {space: key(say('keys_space')), enter: key(say('keys_enter')), tab: key('Tab'), digits: element('span')};
    parts.digits.append(key('1'), '–', key(String(most)));
    const help = fillIn(say(most > 1 ? 'keys' : 'keys_tab'), parts);
    if (!this.stage.oneAtATime) return help;
    const letters = element('span');
    letters.append(key('A'), '–', key('ABCDEFGH'[this.stage.screens.length - 1]));
    return [...help, ' ', ...fillIn(say('keys_show'), {letters})];
  }

  get seconds() {
    return Math.round(performance.now() - this.began) / 1000;
  }

  note(what) {
    if (this.events.length < 500) this.events.push([this.seconds, what]);
  }

  // Which question was answered, as its index in the study.
  noteAnswer(target) {
    const {question} = target.closest('[data-question]').dataset;
    this.note(`answer ${study.questions.findIndex((one) => one.id === question)}`);
  }

  get watched() {
    return this.stage.missing().length === 0;
  }

  get complete() {
    return this.watched && this.form.complete;
  }

  refresh() {
    if (!this.form) return;  // still being made
    byId('questions').disabled = !this.watched;
    byId('next').disabled = !this.complete;
    byId('status').textContent = this.stage.hint || this.openText();
    const visible = this.stage.visible;
    for (const [line, place] of this.places) line.classList.toggle('shown', visible !== null && place === visible.place);
  }

  openText() {
    const {open, problem} = this.form;
    if (open === 0) return problem;
    return this.events.some(([, what]) => what.startsWith('answer')) ? say('open', {n: open}) : say('answer_now');
  }

  // Value 1 of a preference always means that the left video is clearly better; `videos` says which that was.
  entry(skipped) {
    return {
      page: this.step.page.id,
      pass: this.step.number,
      videos: this.step.paths.map(tokenOf),
      values: skipped ? {} : this.form.values(),
      reasons: skipped ? {} : this.form.reasons(),
      skipped,
      seconds: this.seconds,
      events: this.events,
    };
  }

  // A digit answers, the space bar plays, letters show one of several videos.
  press(key) {
    if (key === ' ') {
      this.stage.toggle();
    } else if (/^\d$/.test(key)) {
      return this.watched && this.form.press(key === '0' ? 10 : Number(key));
    } else if (/^[a-h]$/i.test(key) && this.stage.oneAtATime) {
      this.stage.choose(key.toLowerCase().charCodeAt(0) - 97);
    } else {
      return false;
    }
    return true;
  }
}

let trial = null;  // the page that is shown

// Shows a page until it is answered or skipped, and returns its entry of the answers.
async function answerTo(step, {title, seed, upcoming}) {
  loadOnly([...step.paths, ...upcoming]);
  trial = new Trial(step, seed);
  byId('trial-title').textContent = title;
  show('trial');
  fit();
  const shown = trial;
  const skipTimer = study.skip_after === null || study.skip_after === undefined ? null
    : setTimeout(() => {
      byId('skip').disabled = false;
    }, study.skip_after * 1000);
  byId('skip').hidden = skipTimer === null;
  byId('skip').disabled = true;
  const watcher = setInterval(() => showLoading(step.paths, upcoming), 500);
  showLoading(step.paths, upcoming);
  const skipped = await Promise.race([
    submitted(byId('form'), () => shown.complete).then(() => false),
    once(byId('skip'), 'click').then(() => true),
  ]);
  clearTimeout(skipTimer);
  clearInterval(watcher);
  shown.stage.close();
  trial = null;
  return shown.entry(skipped);
}

// Shows how far the next page has loaded, once the videos of this page are loaded.
function showLoading(own, upcoming) {
  const open = upcoming.map(load).filter((one) => !one.ready);
  const busy = open.length > 0 && own.map(load).every((one) => one.ready);
  const share = upcoming.reduce((sum, path) => sum + (load(path).ready ? 1 : load(path).share), 0) / upcoming.length;
  byId('preloading').textContent = busy ? say('loading_next', {percent: Math.floor(share * 100)}) : '';
}

// ---- Room: the videos as large as the window allows without scrolling

const kLeastHeight = 220;  // of a video [px], where the window is wide enough for it
const kColumns = 1000;     // width of a window from which there is room for two columns [px]

// The questions stand below the videos or beside them, whichever leaves larger videos. The form with the most questions
// and the longest caption count, so that videos have one size on all pages.
function fit() {
  if (!trial) return;
  const root = document.documentElement.style;
  root.setProperty('--ratio', String(study.width / study.height));
  placeStatus();
  const others = otherForms(trial.step);
  const below = roomOf('below', others);
  const beside = innerWidth < kColumns ? {wide: 0, height: 0, fits: false} : roomOf('beside', others);
  const better = beside.fits ? beside.height > below.height : below.height < kLeastHeight && beside.height > kLeastHeight;
  const {wide, height} = better ? beside : below;
  const arrangeWithin = (most) => {
    arrange(better ? 'beside' : 'below', Math.floor(Math.min(most, Math.max(kLeastHeight, height))));
  };
  arrangeWithin(wide);
  if (heightOfColumn() < wide) arrangeWithin(heightOfColumn());  // a scrollbar has come
  byId('caption').textContent = trial.step.page.caption;
  byId('caption').hidden = longestCaption() === '';
}

// In a narrow window the videos are out of sight where Next is.
function placeStatus() {
  const status = byId('status');
  const place = document.querySelector(matchMedia('(max-width: 46rem)').matches ? '.next' : '.row');
  if (status.parentElement === place) return;
  if (place.matches('.next')) byId('skip').before(status);
  else place.append(status);
}

function arrange(side, height) {
  byId('trial').className = side;
  byId('stage').style.setProperty('--height', `${height}px`);
}

// The forms of other passes, to measure them.
function otherForms(step) {
  const lists = new Map();
  for (const page of study.pages) {
    for (const pass of page.passes) lists.set(pass.questions.join(), pass.questions);
  }
  lists.delete(step.pass.questions.join());
  const names = namesOf(step.paths.length);
  return [...lists.values()].map((list) => new QuestionForm(list.map((index) => study.questions[index]), {names}));
}

function longestCaption() {
  return study.pages.reduce((longest, page) => (page.caption.length > longest.length ? page.caption : longest), '');
}

// How high a video is that is as wide as its column [px].
function heightOfColumn() {
  const columns = Number(byId('stage').style.getPropertyValue('--columns'));
  const gap = parseFloat(getComputedStyle(byId('stage')).columnGap) || 0;
  return (byId('watch').clientWidth - gap * (columns - 1)) / columns / (study.width / study.height);
}

// How high videos can be with the questions on this side [px], as the width alone allows it, and in the window as well, and
// whether the questions fit into the window. The page's own form stays where it is, because the focus is in it: the others
// take its room for a moment.
function roomOf(side, others) {
  arrange(side, 0);
  byId('caption').hidden = longestCaption() === '';
  byId('caption').textContent = longestCaption();
  const padding = getComputedStyle(byId('main'));
  const free = innerHeight - document.querySelector('header').offsetHeight - parseFloat(padding.paddingTop) -
    parseFloat(padding.paddingBottom);
  const wide = heightOfColumn();
  let height = wide;
  let fits = true;
  const measure = () => {
    const beside = side === 'beside';
    if (beside && byId('form').offsetHeight > free) fits = false;
    height = Math.min(height, free - byId(beside ? 'watch' : 'trial').offsetHeight);
  };
  measure();
  byId('questions').classList.add('aside');
  for (const form of others) {
    const spare = element('fieldset', {className: 'questions'});
    spare.append(...form.elements);
    byId('questions').after(spare);
    measure();
    spare.remove();
  }
  byId('questions').classList.remove('aside');
  return {wide, height, fits};
}

// ---- Keyboard

function pressKey(event) {
  if (!trial || document.querySelector('dialog[open]') || event.ctrlKey || event.altKey || event.metaKey) return;
  const {target, key} = event;
  const types = target.matches('textarea, input[type=text], input[type=number]');
  if (types || (key === ' ' && target.closest('button, input, summary, a'))) return;
  if (key === 'Enter') {
    if (target.closest('button, a')) return;
    event.preventDefault();
    if (trial.complete) byId('form').requestSubmit();
  } else if (byId('shortcuts').checked && trial.press(key)) {
    event.preventDefault();
  }
}

// ---- A window that is too narrow for the videos

const kLeastWidths = {single: 560, pair: 760, triplet: 960, parallel: 560};  // [px]
let narrowAllowed = false;

function watchWidth() {
  const least = oneAtATime() ? kLeastWidths.single : kLeastWidths[study.layout];
  const narrow = innerWidth < least && !narrowAllowed && byId('finish').hidden;
  if (narrow && trial) trial.stage.pause();
  if (narrow && !byId('narrow').open) byId('narrow').showModal();
  if (!narrow && byId('narrow').open) byId('narrow').close();
}

// Nobody sees a video in a page that is hidden.
function watchVisibility() {
  if (!trial) return;
  trial.note(document.hidden ? 'hidden' : 'visible');
  if (document.hidden) trial.stage.pause();
}

function watchWindow() {
  document.addEventListener('keydown', pressKey);
  document.addEventListener('visibilitychange', watchVisibility);
  addEventListener('resize', () => {
    watchWidth();
    fit();
  });
  byId('narrow-anyway').addEventListener('click', () => {
    narrowAllowed = true;
    byId('narrow').close();
  });
  byId('narrow').addEventListener('cancel', () => {
    narrowAllowed = true;
  });
  byId('narrow').addEventListener('close', () => {
    if (document.activeElement === document.body) focusHeading();
  });
  byId('all').addEventListener('click', () => trial && trial.stage.playAll());
  byId('questions').addEventListener('change', (event) => trial && trial.noteAnswer(event.target));
  watchWidth();
}
