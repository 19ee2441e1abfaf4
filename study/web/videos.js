// The videos of a page: loading them before they are needed, and showing them so that each is watched to its end.
'use strict';

// ---- Loading

// From a web server a video is fetched whole before it is shown, so that no slow network makes it stutter. Pages that
// are opened as files may not fetch; there the video reads the file itself.
const kFetches = location.protocol !== 'file:';
const kTries = 4;
const kPatience = 20;  // seconds without a byte until a request is given up

class Load extends EventTarget {
  constructor(path) {
    super();
    this.path = path;
    this.address = kFetches ? null : path;  // of what is loaded
    this.share = 0;                         // of the bytes that have come
    this.failed = false;
    if (kFetches) this.start();
  }

  get ready() {
    return this.address !== null;
  }

  change() {
    this.dispatchEvent(new Event('change'));
  }

  async start() {
    this.failed = false;
    this.change();
    for (let tried = 0; tried < kTries; ++tried) {
      if (tried > 0) await wait(2 ** (tried - 1));
      if (this.dropped) return;
      try {
        const blob = await this.fetch();
        if (!this.dropped) this.address = URL.createObjectURL(blob);
        this.change();
        return;
      } catch {
        // Tried again.
      }
    }
    this.failed = true;
    this.change();
  }

  async fetch() {
    this.abort = new AbortController();
    const guard = () => setTimeout(() => this.abort.abort(), kPatience * 1000);
    let timer = guard();
    try {
      const answer = await fetch(this.path, {signal: this.abort.signal});
      if (!answer.ok) throw new Error(`status ${answer.status}`);
      const all = Number(answer.headers.get('Content-Length')) || 0;
      const reader = answer.body.getReader();
      const parts = [];
      let come = 0;
      for (;;) {
        const {done, value} = await reader.read();
        if (done) break;
        clearTimeout(timer);
        timer = guard();
        parts.push(value);
        come += value.length;
        this.share = all ? Math.min(1, come / all) : 0;
        this.change();
      }
      return new Blob(parts, {type: answer.headers.get('Content-Type') || ''});
    } finally {
      clearTimeout(timer);
    }
  }

  drop() {
    this.dropped = true;
    if (this.abort) this.abort.abort();
    if (kFetches && this.address) URL.revokeObjectURL(this.address);
  }
}

const loads = new Map();  // by path

// Begins to load what is not there yet.
function load(path) {
  if (!loads.has(path)) loads.set(path, new Load(path));
  return loads.get(path);
}

// Loads these, and lets go of all others.
function loadOnly(paths) {
  for (const [path, old] of loads) {
    if (paths.includes(path)) continue;
    old.drop();
    loads.delete(path);
  }
  return paths.map(load);
}

addEventListener('online', () => {
  for (const one of loads.values()) {
    if (one.failed) one.start();
  }
});

// ---- One video

// A video that is watched from its beginning to its end, at its own speed; it cannot be skipped through.
class Screen {
  // `place` counts from the left; `name` is what participants call it, empty for a video that stands alone.
  constructor(stage, {path, place, name, muted}) {
    this.stage = stage;
    this.path = path;
    this.place = place;
    this.name = name;
    this.watched = false;
    this.furthest = 0;  // [s]
    this.wanted = false;  // to play as soon as it is there
    this.video = element('video', {preload: 'auto', playsInline: true, disablePictureInPicture: true, muted: muted});
    this.video.setAttribute('aria-label', name ? say('video_named', {name}) : say('video'));
    this.video.setAttribute('disableremoteplayback', '');
    this.button = element('button', {type: 'button', className: 'play'});
    this.bar = element('progress', {max: 1, value: 0});
    this.bar.setAttribute('aria-label', [name && say('video_named', {name}), say('video_progress')].filter(Boolean).join(': '));
    this.mark = element('span', {className: 'watched'});
    this.message = element('div', {className: 'message', hidden: true, tabIndex: -1});
    this.figure = this.build();
    this.listen();
    this.attach();
  }

  build() {
    const box = element('div', {className: 'screen'});
    box.append(this.video, this.message);
    const controls = element('div', {className: 'controls'});
    controls.append(this.button, this.bar, this.mark);
    const figure = element('figure');
    figure.append(this.stage.captionOf(this), box, controls);
    return figure;
  }

  listen() {
    this.button.addEventListener('click', () => this.toggle());
    this.video.addEventListener('click', () => this.toggle());
    for (const type of ['play', 'pause', 'ended']) {
      this.video.addEventListener(type, () => {
        this.stage.note(`${type} ${this.place}`);
        this.refresh();
      });
    }
    this.video.addEventListener('ended', () => this.end());
    this.video.addEventListener('error', () => this.fail());
    this.video.addEventListener('seeking', () => {
      if (!this.watched && this.video.currentTime > this.furthest + 0.3) this.video.currentTime = this.furthest;
    });
    this.video.addEventListener('ratechange', () => {
      if (!this.watched && this.video.playbackRate !== 1) this.video.playbackRate = 1;
    });
    this.video.addEventListener('timeupdate', () => {
      if (!this.video.seeking) this.furthest = Math.max(this.furthest, this.video.currentTime);
      if (this.video.duration) this.bar.value = this.video.currentTime / this.video.duration;
    });
  }

  // Shows the file as soon as it is loaded.
  attach() {
    this.load = load(this.path);
    this.onLoad = () => this.follow();
    this.load.addEventListener('change', this.onLoad);
    this.follow();
  }

  follow() {
    if (this.load.ready && !this.video.src) {
      this.video.src = this.load.address;
      if (this.wanted) this.play();
    }
    if (this.load.failed) this.stage.note(`error ${this.place}`);
    this.refresh();
  }

  // What came cannot be played: it is loaded anew when the participant asks for it.
  fail() {
    this.broken = true;
    this.stage.note(`error ${this.place}`);
    this.refresh();
  }

  // The button that was pressed goes away: the focus waits in the message, until the video is there.
  retry() {
    this.message.focus();
    if (this.broken) {
      this.broken = false;
      this.load.removeEventListener('change', this.onLoad);
      this.video.removeAttribute('src');
      loads.delete(this.path);
      this.attach();
    } else {
      this.load.start();
    }
  }

  toggle() {
    this.stage.queue = [];
    if (this.video.paused) {
      this.play();
    } else {
      this.video.pause();
    }
  }

  // Two voices at once cannot be judged; silent videos may run together.
  play() {
    this.stage.show(this);
    this.stage.silenceOthers(this);
    this.wanted = !this.load.ready;
    if (this.load.ready) this.video.play().catch(() => this.refresh());
  }

  end() {
    this.watched = true;
    this.bar.value = 1;
    this.refresh();
    this.stage.ended();
  }

  refresh() {
    const name = this.name;
    const verb = !this.video.paused ? 'pause' : 'play';
    const again = this.video.paused && this.watched;
    if (name) {
      this.button.textContent = say(again ? 'play_video_again' : `${verb}_video`, {name});
    } else {
      this.button.textContent = say(again ? 'play_again' : verb);
    }
    this.button.disabled = !this.load.ready || Boolean(this.broken);
    this.mark.replaceChildren(...(this.watched ? ['✓ ', element('span', {}, say('watched'))] : []));
    this.figure.classList.toggle('seen', this.watched);
    this.showMessage();
  }

  showMessage() {
    const failed = this.load.failed || this.broken;
    const hidden = this.load.ready && !failed;
    if (hidden && this.message.contains(document.activeElement)) this.button.focus();
    this.message.hidden = hidden;
    if (hidden) return;
    if (failed) {
      if (this.message.querySelector('button')) return;
      const words = element('p', {}, say(this.broken ? 'playing_failed' : 'loading_failed'));
      words.setAttribute('role', 'alert');
      const again = element('button', {type: 'button'}, say('try_again'));
      again.addEventListener('click', () => this.retry());
      this.message.replaceChildren(words, again);
      return;
    }
    const percent = Math.floor(this.load.share * 100);
    const bar = element('progress', {max: 100, value: percent});
    bar.setAttribute('aria-hidden', 'true');
    this.message.replaceChildren(element('p', {}, say('loading', {percent})), bar);
  }
}

// ---- The videos of a page

class Stage {
  // `paths` from left to right; `names` of the figures, two of one video that shows both. One at a time: of several
  // videos only one is visible; in a fixed order each waits until the one before it has been watched.
  constructor({paths, names, sound, oneAtATime, fixedOrder, note, changed}) {
    this.names = names;
    this.sound = sound;
    this.note = note;
    this.changed = changed;
    this.queue = [];  // screens that play when the one before them ends
    this.fixedOrder = fixedOrder && paths.length > 1;
    this.oneAtATime = (oneAtATime || fixedOrder) && paths.length > 1;
    this.combined = paths.length === 1 && names.length > 1;
    const nameOf = (place) => (paths.length === 1 ? '' : names[place]);
    this.screens = paths.map((path, place) => new Screen(this, {path, place, name: nameOf(place), muted: !sound}));
    this.tabs = this.oneAtATime ? this.screens.map((screen) => this.makeTab(screen)) : [];
    this.visible = null;
    this.show(this.screens[0]);
    this.refresh();
  }

  captionOf(screen) {
    if (this.combined) {
      const halves = element('div', {className: 'halves'});
      halves.append(...this.names.map((name) => element('span', {}, name)));
      return halves;
    }
    return element('figcaption', {}, screen.name);
  }

  makeTab(screen) {
    const tab = element('button', {type: 'button', className: 'tab'});
    tab.addEventListener('click', () => this.choose(screen.place));
    return tab;
  }

  // Shows a video and plays it; the one that is shown already is paused or goes on.
  choose(place) {
    const screen = this.screens[place];
    if (!screen || this.locked(screen)) return;
    if (screen === this.visible) {
      screen.toggle();
    } else {
      this.queue = [];
      screen.play();
    }
  }

  locked(screen) {
    return this.fixedOrder && this.screens.slice(0, screen.place).some((earlier) => !earlier.watched);
  }

  show(screen) {
    if (!this.oneAtATime || screen === this.visible) return;
    if (this.visible) this.visible.video.pause();
    this.visible = screen;
    for (const other of this.screens) other.figure.hidden = other !== screen;
    this.refresh();
    this.changed();
  }

  silenceOthers(screen) {
    if (!this.sound && !this.oneAtATime) return;
    for (const other of this.screens) {
      if (other !== screen) other.video.pause();
      if (other !== screen) other.wanted = false;
    }
  }

  // From the beginning: one after the other with sound or when one is visible at a time, together otherwise.
  playAll() {
    const inTurn = this.sound || this.oneAtATime;
    for (const screen of this.screens) {
      screen.video.pause();
      screen.video.currentTime = 0;
    }
    this.queue = inTurn ? this.screens.slice(1) : [];
    for (const screen of inTurn ? this.screens.slice(0, 1) : this.screens) screen.play();
  }

  get playAllText() {
    return say(this.sound || this.oneAtATime ? 'play_in_turn' : 'play_together');
  }

  // The space bar: pauses what plays, or plays what has not been watched.
  toggle() {
    const playing = this.screens.filter((screen) => !screen.video.paused);
    if (playing.length > 0) this.pause();
    else (this.screens.find((screen) => !screen.watched) || this.visible || this.screens[0]).toggle();
  }

  // Nothing plays, and nothing begins by itself.
  pause() {
    this.queue = [];
    for (const screen of this.screens) {
      screen.wanted = false;
      screen.video.pause();
    }
  }

  ended() {
    this.refresh();
    this.changed();
    const next = this.queue.shift();
    if (next) next.play();
  }

  refresh() {
    this.tabs.forEach((tab, place) => {
      const screen = this.screens[place];
      tab.textContent = this.names[place];
      if (screen.watched) tab.append(element('span', {className: 'done'}, '✓'));
      tab.disabled = this.locked(screen);
      tab.setAttribute('aria-pressed', String(screen === this.visible));
      const parts = [say('play_video', {name: this.names[place]}), screen.watched ? say('watched') : ''];
      tab.setAttribute('aria-label', parts.filter(Boolean).join(', '));
    });
  }

  missing() {
    return this.screens.filter((screen) => !screen.watched);
  }

  // What is still to be watched, in words.
  get hint() {
    const missing = this.missing();
    if (missing.length === 0) return '';
    if (this.screens.length === 1) return say('watch_one');
    if (missing.length === 1) return say('watch_other', {name: missing[0].name});
    return say(this.screens.length === 2 ? 'watch_both' : 'watch_all');
  }

  close() {
    this.pause();
    for (const screen of this.screens) screen.load.removeEventListener('change', screen.onLoad);
  }
}
