// Who takes part, what was answered, and where the answers go: to the server if the study has one, and always into the
// browser's own store, so that a reload or a lost connection loses nothing.
'use strict';

// ---- Who

// The parameters of a platform's link that are kept. No others are.
const kArrivedWith = ['PROLIFIC_PID', 'STUDY_ID', 'SESSION_ID'];

// Control characters are in no name, and stand in the way of tables.
function plain(text, most) {
  return (text || '').replace(/[\u0000-\u001f\u007f]/g, '').trim().slice(0, most);
}

// Beside a platform's name `p` is one that many share, such as that of a wave.
function arrivedWith(query) {
  const names = plain(query.get('PROLIFIC_PID')) ? ['p', ...kArrivedWith] : kArrivedWith;
  const given = names.filter((name) => plain(query.get(name)));
  return Object.fromEntries(given.map((name) => [name, plain(query.get(name), 200)]));
}

const kNameKey = `chironomia ${study.study} participant`;

// A panel should have filled in {{%PROLIFIC_PID%}} (Prolific) or ${e://Field/PROLIFIC_PID} (Qualtrics).
function isUnfilled(text) {
  return text.startsWith('{{%') || text.startsWith('${e://');
}

// Prolific's parameter or ?p=ID names the participant. Where Prolific's is not filled in, `p` may be one that many share.
function nameGiven(query) {
  const name = plain(query.get('PROLIFIC_PID'), 100) || plain(query.get('p'), 100);
  return isUnfilled(name) ? '' : name;
}

// Without a name in the link the browser draws one, and keeps it.
function drawnName() {
  const bytes = crypto.getRandomValues(new Uint8Array(6));
  return readKept(kNameKey) || Array.from(bytes, (byte) => byte.toString(16).padStart(2, '0')).join('');
}

// Without a server: ?sheet=N gives the sheet (?order=N does too). A number as a name takes its sheet in turn; other
// names are spread over the sheets.
function findSheet(query, participant) {
  for (const text of [query.get('sheet'), query.get('order'), participant]) {
    if (text !== null && /^\d{1,9}$/.test(text)) return Number(text) % study.sheets.length;
  }
  return spread(participant) % study.sheets.length;
}

// A server gives each participant the pages of their own sheet, and nobody others; before that there are those for practice.
const kPagesOfAll = study.pages.length;
const hasNoSheets = study.sheets.length === 0;

function takeSheet(sheet, pages) {
  study.pages = [...study.pages.slice(0, kPagesOfAll), ...pages];
  study.sheets[sheet] = {pages: pages.map((page, at) => [kPagesOfAll + at, page.videos.map((_, place) => place)])};
}

// ---- What is kept over a reload; a browser that keeps nothing still shows the study

function readKept(key) {
  try {
    return JSON.parse(localStorage.getItem(key));
  } catch {
    return null;
  }
}

function keepAs(key, value) {
  try {
    localStorage.setItem(key, JSON.stringify(value));
    return true;
  } catch {
    return false;  // private windows may refuse
  }
}

// Another window of this browser has gone on with the study.
class Overtaken extends Error {}

// Grows with each answer, with the questionnaire and at the end.
function progressOf(state) {
  return state.sent.answers.length + Number(state.asked) + Number(state.finished);
}

// Everything that the page knows of its participant.
class Participation {
  constructor(query) {
    const given = nameGiven(query);
    const participant = given || drawnName();
    this.isDrawn = !given;  // the next person at this computer may come by a link without a name
    this.key = `chironomia ${study.study} answers ${participant}`;
    this.kept = true;
    this.state = Object.assign({
      sent: {
        format: 'chironomia answers 2',
        study: study.study,
        participant: participant,
        sheet: null,
        simulated: false,
        started: null,
        finished: null,
        browser: navigator.userAgent,
        arrived_with: arrivedWith(query),
        questionnaire: {},
        answers: [],
      },
      agreed: false,       // to the consent
      introduced: false,   // has read the instructions
      heard: false,        // has passed the sound check
      practised: 0,        // passes of practice pages
      trained: false,      // has read that the practice is over
      asked: false,        // has filled the questionnaire in
      session: null,       // with a server
      stored: 0,           // answers that the server has acknowledged
      completion: null,    // as the server gave it at the end
      finished: false,
    }, readKept(this.key));
    this.staticSheet = findSheet(query, participant);
    this.known = progressOf(this.state);  // as the browser keeps it
  }

  get sent() {
    return this.state.sent;
  }

  // What a participant hands over; what came from another browser is with the server alone.
  get text() {
    return JSON.stringify({...this.sent, answers: this.sent.answers.filter(Boolean)}, null, 2) + '\n';
  }

  get fileName() {
    return `answers-${study.study}-${this.sent.participant.replace(/[^A-Za-z0-9_-]/g, '_')}.json`;
  }

  // This browser keeps nothing of it any more.
  forget() {
    this.kept = true;
    try {
      if (this.isDrawn) localStorage.removeItem(kNameKey);
      localStorage.removeItem(this.key);
    } catch {
      // a browser that keeps nothing has nothing to forget
    }
  }

  // Throws Overtaken where another window has kept more since, which would be lost.
  keep(changes = {}) {
    const other = readKept(this.key);
    if (other && progressOf(other) > this.known) throw new Overtaken();
    Object.assign(this.state, changes);
    if (this.isDrawn) keepAs(kNameKey, this.sent.participant);
    this.kept = keepAs(this.key, this.state);
    this.known = progressOf(this.state);
  }
}

// ---- The server

// The connection is lost or the server is busy: the same may be sent again after `wait` seconds.
class Lost extends Error {
  constructor(wait = 0) {
    super('the connection is lost');
    this.wait = wait;
  }
}

// The server does not want what it was sent.
class Refused extends Error {
  constructor(status, answer) {
    super(answer.error);
    this.status = status;
    this.full = answer.full === true;
    this.url = (answer.completion && answer.completion.url) || null;
  }
}

// The session is not known to the server any more.
function isOfNobody(problem) {
  return problem instanceof Refused && problem.status === 403;
}

const kAnswerPatience = 20;  // seconds until an answer of the server is given up

async function answerOf(response) {
  try {
    const answer = await response.json();
    return answer !== null && typeof answer === 'object' ? answer : null;
  } catch {
    return null;
  }
}

// What the server answers; null where there is none.
async function post(path, body) {
  const abort = new AbortController();
  const timer = setTimeout(() => abort.abort(), kAnswerPatience * 1000);
  let response;
  let answer;
  try {
    response = await fetch(path, {
      method: 'POST',
      headers: {'Content-Type': 'application/json'},
      body: JSON.stringify(body),
      signal: abort.signal,
    });
    answer = await answerOf(response);
  } catch {
    throw new Lost();
  } finally {
    clearTimeout(timer);
  }
  if (response.ok && answer && !('error' in answer)) return answer;
  if (response.status === 429 || response.status === 503) throw new Lost(Number(response.headers.get('Retry-After')) || 0);
  if (answer && typeof answer.error === 'string') {
    if (response.status >= 500) throw new Lost();
    throw new Refused(response.status, answer);
  }
  if (response.status === 500 || response.status === 502 || response.status === 504) throw new Lost();
  return null;
}

// Hands the answers on, one after the other, and knows what has arrived. `patiently` runs an action until it is not lost.
class Messenger {
  constructor(participation, patiently) {
    this.who = participation;
    this.state = participation.state;
    this.patiently = patiently;
    this.online = this.state.session !== null;
  }

  // Whether the server has deleted what this browser keeps: the participant withdrew in another window, or asked for it.
  async isDeleted() {
    if (!this.state.session) return false;
    try {
      await this.patiently(() => this.deliver('api/stored', {session: this.state.session}));
      return false;
    } catch (problem) {
      if (!isOfNobody(problem)) throw problem;
      return true;
    }
  }

  // Finds out which sheet to show, and how many answers are there already.
  async begin() {
    const {sent} = this.who;
    const without = !this.online && sent.sheet !== null && !hasNoSheets;  // who began without a server ends so
    if (location.protocol !== 'file:' && !without) await this.askServer();
    if (sent.sheet === null) sent.sheet = this.who.staticSheet;
    if (!sent.started) sent.started = new Date().toISOString();
    this.who.keep();
    await this.send();
  }

  async askServer() {
    const {sent} = this.who;
    const body = {participant: sent.participant, arrived_with: sent.arrived_with, browser: sent.browser};
    if (this.state.session) body.session = this.state.session;
    const answer = await this.patiently(async () => {
      const got = await post('api/begin', body);
      if (!got && (this.online || hasNoSheets)) throw new Lost();  // there was one before
      return got;
    });
    if (!answer || typeof answer.session !== 'string') return;
    this.online = true;
    sent.sheet = answer.sheet;
    if (hasNoSheets) takeSheet(answer.sheet, answer.pages);
    while (sent.answers.length < answer.answered) sent.answers.push(null);  // given in another browser
    this.who.keep({session: answer.session, stored: answer.answered, finished: answer.finished === true});
  }

  // Keeps an answer, and returns when the server has acknowledged it.
  async hand(answer) {
    this.who.sent.answers.push(answer);
    this.who.keep();
    await this.send();
  }

  async send() {
    const {answers} = this.who.sent;
    while (this.online && this.state.stored < answers.length) {
      const number = this.state.stored;
      try {
        const body = {session: this.state.session, number, answer: answers[number]};
        const answer = await this.patiently(() => this.deliver('api/answer', body));
        this.who.keep({stored: Math.max(answer.stored, number + 1)});
      } catch (problem) {
        if (problem.status !== 409) throw problem;
        await this.askServer();  // another window may have answered
        if (this.state.stored <= number) throw problem;
      }
    }
  }

  async deliver(path, body) {
    const answer = await post(path, body);
    if (!answer) throw new Lost();
    return answer;
  }

  async finish(questionnaire) {
    const {sent} = this.who;
    if (questionnaire) sent.questionnaire = questionnaire;
    this.who.keep({asked: true});
    if (this.online) {
      const body = {session: this.state.session, questionnaire: sent.questionnaire};
      const answer = await this.patiently(() => this.deliver('api/finish', body));
      this.state.completion = answer.completion;
    }
    if (!sent.finished) sent.finished = new Date().toISOString();
    this.who.keep({finished: true});
  }

  // All that is stored: by the server, or by this browser alone; null before anything is.
  async stored() {
    if (!this.online) return this.state.sent.started ? this.state.sent : null;
    return this.deliver('api/stored', {session: this.state.session});
  }

  // Deletes what a server has. One that does not know the session any more has deleted it before.
  async withdraw() {
    if (this.online) {
      try {
        await this.deliver('api/withdraw', {session: this.state.session});
      } catch (problem) {
        if (!isOfNobody(problem)) throw problem;
      }
    }
  }

  // Where those go who do not agree; nothing is kept of them.
  async decline() {
    const otherwise = (study.completion || {}).declined_url || null;
    if (location.protocol === 'file:') return otherwise;
    try {
      const answer = await post('api/decline', {});
      return (answer && answer.completion && answer.completion.url) || otherwise;
    } catch {
      return otherwise;
    }
  }
}
