// Shows the pages of a study one after the other, and keeps the answers.
//
// The study's data is the JSON in the element "pages". Nothing is loaded from elsewhere but the videos, and nothing is
// sent: the answers stay in the browser until the participant saves them as a file.
'use strict';

const study = JSON.parse(document.getElementById('pages').textContent);
const kVideosOfPage = study.pages[0].videos.length;  // 2, or 1 that shows both figures
const kNames = ['A', 'B'];
const byId = (id) => document.getElementById(id);

// ---- Who takes part, and in which order

// ?p=ID (or Prolific's parameter) names the participant; without it the browser draws a name and keeps it.
function findParticipant() {
  const query = new URLSearchParams(location.search);
  const given = query.get('p') || query.get('PROLIFIC_PID');
  if (given) return given.slice(0, 100);
  const key = `chironomia ${study.study} participant`;
  const drawn = load(key) || Array.from(crypto.getRandomValues(new Uint8Array(6)),
                                        (byte) => byte.toString(16).padStart(2, '0')).join('');
  store(key, drawn);
  return drawn;
}

// ?order=N fixes the order. A number as a name takes its order in turn; other names are spread over the orders.
function findOrder(participant) {
  const given = new URLSearchParams(location.search).get('order');
  for (const text of [given, participant]) {
    if (text !== null && /^\d{1,9}$/.test(text)) return Number(text) % study.orders.length;
  }
  return spread(participant) % study.orders.length;
}

// FNV-1a, 32 bits, with a last mixing, so that names that differ in one letter take unlike orders.
function spread(text) {
  let hash = 0x811c9dc5;
  for (const byte of new TextEncoder().encode(text)) hash = Math.imul(hash ^ byte, 0x01000193);
  hash = Math.imul(hash ^ (hash >>> 16), 0x7feb352d);
  hash = Math.imul(hash ^ (hash >>> 15), 0x846ca68b);
  return (hash ^ (hash >>> 16)) >>> 0;
}

// ---- What is kept over a reload; a browser that keeps nothing still shows the study

function load(key) {
  try {
    return JSON.parse(localStorage.getItem(key));
  } catch {
    return null;
  }
}

function store(key, value) {
  try {
    localStorage.setItem(key, JSON.stringify(value));
  } catch {
    // Private windows may refuse.
  }
}

const participant = findParticipant();
const kStateKey = `chironomia ${study.study} answers ${participant}`;
const state = load(kStateKey) || {
  format: 'chironomia answers 1',
  study: study.study,
  participant: participant,
  order: findOrder(participant),
  started: null,
  finished: null,
  browser: navigator.userAgent,
  answers: [],
};
const order = study.orders[state.order];

// ---- Sections

function show(id) {
  for (const section of ['intro', 'trial', 'finish']) byId(section).hidden = section !== id;
  byId('progress').hidden = id !== 'trial';
  byId('main').focus({preventScroll: true});
  scrollTo(0, 0);
}

function showIntro() {
  byId('instructions').textContent = study.instructions;
  const needs = [`There are ${study.pages.length} pages; they take about ${minutes()}.`];
  if (study.sound) needs.push('Please use headphones or loudspeakers in a quiet place.');
  needs.push('A computer or a tablet with a large screen is best.');
  needs.push('If you must stop, open this page again in the same browser: it goes on where you were.');
  byId('requirements').replaceChildren(...needs.map((text) => element('li', {}, text)));
  const begun = state.answers.length > 0;
  byId('start').textContent = begun ? 'Go on' : 'Start';
  byId('resume-note').hidden = !begun;
  byId('resume-note').textContent = `You have answered ${state.answers.length} of ${study.pages.length} pages.`;
  show('intro');
}

// Watching everything once, and 15 s a page to think.
function minutes() {
  const seconds = study.pages.reduce((sum, page) => sum + page.seconds * page.videos.length + 15, 0);
  const whole = Math.max(1, Math.round(seconds / 60));
  return whole === 1 ? 'one minute' : `${whole} minutes`;
}

function element(name, properties = {}, text = '') {
  const made = Object.assign(document.createElement(name), properties);
  if (text) made.textContent = text;
  return made;
}

// ---- A page

let screens = [];     // of the page that is shown
let queue = [];       // screens that play when the one before them ends
let pageBegan = 0;    // performance.now() when it was shown [ms]
let events = [];      // [seconds since then, what happened]
let preloaded = [];   // videos of the page after it

function note(what) {
  events.push([Math.round(performance.now() - pageBegan) / 1000, what]);
}

// The paths of a page's videos from left to right, as this participant sees them.
function videosOf(page) {
  return order.swapped ? [...page.videos].reverse() : page.videos;
}

function currentPage() {
  return study.pages[order.pages[state.answers.length]];
}

// A video that is watched from its beginning to its end; it cannot be skipped through.
class Screen {
  constructor(path, name) {
    this.name = name;
    this.watched = false;
    this.furthest = 0;  // [s]
    this.video = element('video', {src: path, preload: 'auto', playsInline: true, disablePictureInPicture: true});
    this.video.setAttribute('aria-label', name ? `Video ${name}` : 'Video');
    this.button = element('button', {type: 'button'});
    this.bar = element('progress', {max: 1, value: 0});
    this.bar.setAttribute('aria-label', name ? `How far video ${name} has played` : 'How far the video has played');
    this.mark = element('span', {className: 'watched'});
    this.figure = this.build();
    this.listen();
    this.refresh();
  }

  build() {
    const figure = element('figure');
    const box = element('div', {className: 'screen'});
    box.append(this.video);
    const caption = element(this.name ? 'figcaption' : 'div', {className: this.name ? '' : 'halves'});
    if (this.name) {
      caption.append(element('span', {}, this.name));
    } else {
      caption.append(...kNames.map((name) => element('span', {}, name)));
    }
    const controls = element('div', {className: 'controls'});
    controls.append(this.button, this.bar, this.mark);
    figure.append(caption, box, controls);
    this.box = box;
    return figure;
  }

  listen() {
    this.button.addEventListener('click', () => this.toggle());
    this.video.addEventListener('click', () => this.toggle());
    for (const type of ['play', 'pause', 'ended']) {
      this.video.addEventListener(type, () => {
        note(`${type} ${this.name}`.trim());
        this.refresh();
      });
    }
    this.video.addEventListener('ended', () => this.finish());
    this.video.addEventListener('error', () => this.fail());
    this.video.addEventListener('seeking', () => {
      if (!this.watched && this.video.currentTime > this.furthest + 0.3) this.video.currentTime = this.furthest;
    });
    this.video.addEventListener('timeupdate', () => {
      if (!this.video.seeking) this.furthest = Math.max(this.furthest, this.video.currentTime);
      if (this.video.duration) this.bar.value = this.video.currentTime / this.video.duration;
    });
  }

  toggle() {
    queue = [];
    if (this.video.paused) {
      this.play();
    } else {
      this.video.pause();
    }
  }

  // Two voices at once cannot be judged; silent videos may run together.
  play() {
    for (const other of screens) {
      if (other !== this && study.sound) other.video.pause();
    }
    this.video.play().catch(() => this.refresh());
  }

  finish() {
    this.watched = true;
    this.bar.value = 1;
    this.refresh();
    refreshForm();
    const next = queue.shift();
    if (next) next.play();
  }

  fail() {
    note(`error ${this.name}`.trim());
    const message = element('div', {className: 'message'});
    const retry = element('button', {type: 'button'}, 'Try again');
    retry.addEventListener('click', () => {
      message.remove();
      this.video.load();
    });
    message.append(element('p', {}, 'This video could not be loaded. Please check your connection.'), retry);
    this.box.append(message);
  }

  refresh() {
    const verb = this.video.paused ? 'Play' : 'Pause';
    const again = this.video.paused && this.watched ? 'again' : '';
    this.button.textContent = [verb, this.name, again].filter(Boolean).join(' ');
    this.mark.textContent = this.watched ? '✓ watched' : '';
  }
}

// From the beginning: one after the other with sound, together without.
function playBoth() {
  for (const screen of screens) {
    screen.video.pause();
    screen.video.currentTime = 0;
  }
  queue = study.sound ? screens.slice(1) : [];
  for (const screen of study.sound ? screens.slice(0, 1) : screens) screen.play();
}

function showPage() {
  const page = currentPage();
  const paths = videosOf(page);
  screens = paths.map((path, i) => new Screen(path, paths.length === 1 ? '' : kNames[i]));
  byId('stage').replaceChildren(...screens.map((screen) => screen.figure));
  queue = [];
  byId('both').hidden = screens.length === 1;
  byId('form').reset();
  const number = state.answers.length + 1;
  byId('progress-text').textContent = `Page ${number} of ${study.pages.length}`;
  byId('progress-bar').value = (number - 1) / study.pages.length;
  byId('next').textContent = number === study.pages.length ? 'Finish' : 'Next';
  pageBegan = performance.now();
  events = [];
  refreshForm();
  preloadNext();
  show('trial');
}

// The browser fetches the next page's videos while this one is watched.
function preloadNext() {
  const next = study.pages[order.pages[state.answers.length + 1]];
  preloaded = next ? next.videos.map((path) => element('video', {src: path, preload: 'auto', muted: true})) : [];
}

function chosen() {
  const checked = byId('form').querySelector('input:checked');
  return checked ? Number(checked.value) : null;
}

function refreshForm() {
  const missing = screens.filter((screen) => !screen.watched);
  byId('choices').disabled = missing.length > 0;
  byId('next').disabled = missing.length > 0 || chosen() === null;
  byId('status').textContent = statusText(missing);
}

function statusText(missing) {
  if (missing.length === 0) return chosen() === null ? 'Now choose an answer. You may watch again.' : '';
  if (screens.length === 1) return 'Watch the video to its end to answer.';
  if (missing.length === 2) return 'Watch both videos to their end to answer.';
  return `Watch video ${missing[0].name} to its end too.`;
}

// Answer 1 always means that the left video, A, is clearly better; `videos` says which that was.
function recordAnswer() {
  const page = currentPage();
  state.answers.push({
    page: page.id,
    videos: videosOf(page).map((path) => path.replace(/^.*\/|\.[^.]*$/g, '')),
    swapped: order.swapped,
    answer: chosen(),
    seconds: Math.round(performance.now() - pageBegan) / 1000,
    events: events,
  });
  if (state.answers.length === study.pages.length) state.finished = new Date().toISOString();
  store(kStateKey, state);
}

function goOn() {
  for (const screen of screens) screen.video.pause();
  if (state.answers.length < study.pages.length) {
    showPage();
  } else {
    showFinish();
  }
}

// ---- The end

function showFinish() {
  screens = [];
  byId('stage').replaceChildren();
  const text = JSON.stringify(state, null, 2) + '\n';
  const link = byId('download');
  link.href = URL.createObjectURL(new Blob([text], {type: 'application/json'}));
  link.download = `answers-${study.study}-${participant.replace(/[^A-Za-z0-9_-]/g, '_')}.json`;
  link.onclick = () => {
    byId('saved').textContent = `Saved as ${link.download} in your downloads. You may close this page once it is sent.`;
  };
  byId('answer-text').value = text;
  show('finish');
}

// ---- Keyboard

function pressKey(event) {
  if (byId('trial').hidden || event.ctrlKey || event.altKey || event.metaKey) return;
  const target = event.target;
  if (event.key === ' ' && !target.closest('button, input, summary, a')) {
    event.preventDefault();
    (screens.find((screen) => !screen.video.paused) || screens.find((screen) => !screen.watched) || screens[0]).toggle();
  } else if (/^[1-5]$/.test(event.key) && !byId('choices').disabled) {
    byId('answers').querySelectorAll('input')[Number(event.key) - 1].checked = true;
    refreshForm();
  } else if (event.key === 'Enter' && !target.closest('button, input') && !byId('next').disabled) {
    event.preventDefault();
    byId('form').requestSubmit();
  }
}

// ---- Begin

function buildAnswers() {
  byId('question').textContent = study.question;
  byId('answers').replaceChildren(...study.answers.map((text, i) => {
    const label = element('label');
    label.append(element('input', {type: 'radio', name: 'answer', value: String(i + 1)}), element('span', {}, text));
    return label;
  }));
}

function begin() {
  byId('title').textContent = study.title;
  const root = document.documentElement.style;
  root.setProperty('--aspect', `${study.width} / ${study.height}`);
  root.setProperty('--ratio', String(study.width / study.height));
  root.setProperty('--columns', String(kVideosOfPage));
  buildAnswers();
  byId('start').addEventListener('click', () => {
    if (!state.started) state.started = new Date().toISOString();
    store(kStateKey, state);
    goOn();
  });
  byId('both').textContent = study.sound ? 'Play A, then B' : 'Play both together';
  byId('both').addEventListener('click', playBoth);
  byId('answers').addEventListener('change', refreshForm);
  byId('form').addEventListener('submit', (event) => {
    event.preventDefault();
    if (byId('next').disabled) return;
    recordAnswer();
    goOn();
  });
  document.addEventListener('keydown', pressKey);
  if (state.finished) {
    showFinish();
  } else {
    showIntro();
  }
}

begin();
