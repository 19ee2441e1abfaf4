// The questions of a page or of the questionnaire, and what was answered.
//
// Questions of one scale stand together as a matrix: one line each, the scale once above them. A line is what a digit of
// the keyboard answers: {element, open(), pick(n)}.
'use strict';

// ---- Order

// FNV-1a, 32 bits, with a last mixing, so that names that differ in one letter become unlike numbers.
function spread(text) {
  let hash = 0x811c9dc5;
  for (const byte of new TextEncoder().encode(text)) hash = Math.imul(hash ^ byte, 0x01000193);
  hash = Math.imul(hash ^ (hash >>> 16), 0x7feb352d);
  hash = Math.imul(hash ^ (hash >>> 15), 0x846ca68b);
  return (hash ^ (hash >>> 16)) >>> 0;
}

// The list in an order that depends on the seed alone, so that a reload shows the same.
function shuffled(list, seed) {
  const mixed = [...list];
  for (let i = mixed.length - 1; i > 0; --i) {
    const other = spread(`${seed} ${i}`) % (i + 1);
    [mixed[i], mixed[other]] = [mixed[other], mixed[i]];
  }
  return mixed;
}

// What questions must share to stand in one matrix; null for those that stand alone.
function scaleOf(question) {
  if (question.reasons || question.each || question.of_videos) return null;
  const {kind, answers, points, labels, options, optional} = question;
  if (!['preference', 'rating', 'choice'].includes(kind)) return null;
  return JSON.stringify([kind, answers, points, labels, options, Boolean(optional)]);
}

// Lists of questions that stand together.
function groupsOf(questions, seed) {
  const groups = new Map();
  for (const question of questions) {
    const scale = scaleOf(question) || question.id;
    if (!groups.has(scale)) groups.set(scale, []);
    groups.get(scale).push(question);
  }
  const inOrder = [...groups.values()];
  return seed === null ? inOrder : shuffled(inOrder.map((group) => shuffled(group, seed)), seed);
}

// ---- Parts

let madeIds = 0;
const newId = (name) => `${name}-${++madeIds}`;

// Sends the event of a change by a key or a button, as the browser does for a change by a pointer.
function announceChange(changed) {
  changed.dispatchEvent(new Event('change', {bubbles: true}));
}

function questionText(question, tag = 'span') {
  const text = element(tag, {className: 'question', dir: 'auto'}, question.text);
  if (question.optional) text.append(' ', element('span', {className: 'optional'}, `(${say('optional')})`));
  return text;
}

function fieldsetOf(question, className) {
  const field = element('fieldset', {className: `field ${className}`});
  field.append(questionText(question, 'legend'));
  return field;
}

// The options of a question as [{value, text}].
function optionsOf(question, names) {
  if (question.of_videos) return names.map((name, place) => ({value: place, text: name}));
  if (question.options) return question.options.map(({id, text}) => ({value: id, text}));
  if (question.answers) return question.answers.map((text, i) => ({value: i + 1, text}));
  return Array.from({length: question.points}, (_, i) => ({value: i + 1, text: String(i + 1)}));
}

// Radio buttons of which one is chosen; `value` is null until then.
class Radios {
  constructor(options, changed) {
    const name = newId('answer');
    this.options = options;
    this.inputs = options.map((option, i) => element('input', {type: 'radio', name, value: String(i)}));
    for (const input of this.inputs) input.addEventListener('change', changed);
  }

  get value() {
    const at = this.inputs.findIndex((input) => input.checked);
    return at < 0 ? null : this.options[at].value;
  }

  open() {
    return this.value === null;
  }

  get begun() {
    return !this.open();
  }

  clear() {
    for (const input of this.inputs) input.checked = false;
  }

  pick(n) {
    if (n < 1 || n > this.inputs.length) return false;
    this.inputs[n - 1].checked = true;
    announceChange(this.inputs[n - 1]);
    return true;
  }

  focus() {
    (this.inputs.find((input) => input.checked) || this.inputs[0]).focus();
  }
}

// ---- Kinds. Each is {question, element, lines, value()} and, where it asks more, problem() and reasons().

// Many options stand in rows of the same length, of at most six.
function columnsOf(options) {
  return options <= 7 ? options : Math.ceil(options / Math.ceil(options / 6));
}

// One question with its answers side by side.
function makeCards(question, names, changed) {
  const radios = new Radios(optionsOf(question, names), changed);
  const field = fieldsetOf(question, 'cards');
  const row = element('div', {className: 'options', dir: question.answers || question.of_videos ? 'ltr' : ''});
  row.style.setProperty('--options', String(columnsOf(radios.options.length)));
  radios.inputs.forEach((input, i) => {
    const label = element('label');
    label.append(input, element('span', {dir: 'auto'}, radios.options[i].text));
    row.append(label);
  });
  field.append(row);
  radios.element = row;
  const made = {question, element: field, lines: [radios], value: () => radios.value};
  if (question.reasons) addReasons(made, field, changed);
  return made;
}

// Why? One or more reasons, unless the answer is the one that needs none. They are always there, so that nothing moves.
function addReasons(made, field, changed) {
  const {text, options, other, unless} = made.question.reasons;
  const list = element('fieldset', {className: 'reasons', disabled: true});
  list.append(element('legend', {}, text));
  const boxes = options.map((option) => {
    const box = element('input', {type: 'checkbox', value: option.id});
    const label = element('label');
    label.append(box, element('span', {}, option.text));
    list.append(label);
    return box;
  });
  const words = element('input', {type: 'text', maxLength: 1000, autocomplete: 'off'});
  if (other) {
    const label = element('label', {className: 'other'});
    label.append(element('span', {}, other), words);
    list.append(label);
  }
  list.addEventListener('input', changed);
  field.append(list);
  const needed = () => made.value() !== null && made.value() !== unless;
  made.refresh = () => {
    list.disabled = !needed();
  };
  made.reasons = () => {
    if (!needed()) return null;
    return {chosen: boxes.filter((box) => box.checked).map((box) => box.value), other: words.value.trim()};
  };
  made.problem = () => {
    const given = made.reasons();
    return given && given.chosen.length === 0 && !given.other ? say('give_reason') : '';
  };
}

// The scale once, and a line for each question, or for each video of one question.
function makeMatrix(lines, scale, names, changed, place) {
  const options = optionsOf(scale, names);
  const grid = element('div', {className: 'matrix', dir: 'ltr'});
  grid.style.setProperty('--options', String(options.length));
  if (scale.kind !== 'rating' || hasLabels(scale)) grid.append(headOf(scale, options));
  const words = wordsOf(scale, options);
  grid.classList.toggle('wordy', words.length > 0);
  return {grid, radios: lines.map(({text, isPlace, name}) => {
    const radios = new Radios(options, changed);
    const line = element('div', {className: 'line'});
    line.setAttribute('role', 'radiogroup');
    line.setAttribute('aria-label', name);
    const head = element('div', {className: 'text'});
    head.append(text);
    line.append(head);
    if (isPlace !== undefined) place(line, isPlace);
    radios.inputs.forEach((input, i) => {
      const label = element('label');
      input.setAttribute('aria-label', spokenOption(scale, options, i));
      label.append(input);
      if (scale.kind === 'rating') label.append(element('span', {}, options[i].text));
      if (words[i]) label.append(element('span', {className: 'word', dir: 'auto'}, words[i]));
      line.append(label);
    });
    grid.append(line);
    radios.element = line;
    return radios;
  })};
}

const hasLabels = (scale) => Object.keys(scale.labels || {}).length > 0;

// What stands beside each answer where a window is too narrow for columns of words; none where only the ends have words.
function wordsOf(scale, options) {
  if (scale.kind !== 'rating') return options.map((option) => option.text);
  const labels = scale.labels || {};
  return Object.keys(labels).length > 2 ? options.map((_, i) => labels[String(i + 1)] || '') : [];
}

function spokenOption(scale, options, i) {
  const label = scale.kind === 'rating' && (scale.labels || {})[String(i + 1)];
  return label ? `${options[i].text}, ${label}` : options[i].text;
}

// What stands above the columns: the answers, or the labels of the numbers that have some.
function headOf(scale, options) {
  const head = element('div', {className: 'head'});
  head.setAttribute('aria-hidden', 'true');
  head.append(element('span'));
  if (scale.kind !== 'rating') {
    head.append(...options.map((option) => element('span', {dir: 'auto'}, option.text)));
    return head;
  }
  const row = element('div', {className: 'ends'});
  const labelled = Object.entries(scale.labels).map(([n, text]) => [Number(n), text]).sort(([a], [b]) => a - b);
  const gap = Math.min(options.length, ...labelled.slice(1).map(([n], i) => n - labelled[i][0]));
  const reach = Math.floor((gap - 1) / 2);  // columns to each side that a label may take; those at the ends take the rest
  for (const [n, text] of labelled) {
    const label = element('span', {dir: 'auto'}, text);
    const from = n === options.length ? n - (gap - reach) + 1 : n - reach;
    const to = n === 1 ? gap - reach : n + reach;
    label.style.gridColumn = `${Math.max(1, from)} / ${Math.min(options.length, to) + 1}`;
    label.className = n === 1 ? 'first' : n === options.length ? 'last' : '';
    row.append(label);
  }
  row.classList.toggle('two', labelled.length <= 2);
  head.append(row);
  return head;
}

// Questions of one scale: one made question each, in one matrix.
function makeGroup(questions, names, changed) {
  const scale = questions[0];
  if (questions.length === 1 && scale.kind !== 'rating') return [makeCards(scale, names, changed)];
  const lines = questions.map((question) => questionText(question)).map((text) => ({text, name: text.textContent}));
  const {grid, radios} = makeMatrix(lines, scale, names, changed);
  grid.classList.toggle('alone', questions.length === 1);
  return questions.map((question, i) => {
    radios[i].element.dataset.question = question.id;
    return {question, element: i === 0 ? grid : null, lines: [radios[i]], value: () => radios[i].value};
  });
}

// A participant who began to answer an optional question of all videos may take everything back, to leave it open.
function offerToClear({question, element: field, lines}, changed) {
  if (!question.optional || !question.each) return;
  const again = element('button', {type: 'button', className: 'plain', disabled: true}, say('rank_again'));
  again.addEventListener('click', () => {
    for (const line of lines) line.clear();
    changed();
  });
  field.querySelector('legend').append(' ', again);
  return () => {
    again.disabled = !lines.some((line) => line.begun);
  };
}

// One question of every video by itself.
function makeEach(question, names, changed, place) {
  const field = fieldsetOf(question, 'each');
  const lines = names.map((name, i) => ({text: name, isPlace: i, name: `${question.text} ${name}`}));
  const {grid, radios} = makeMatrix(lines, question, names, changed, place);
  grid.classList.add('videos');
  field.append(grid);
  const made = {question, element: field, lines: radios, value: () => arrayOf(radios.map((one) => one.value))};
  made.refresh = offerToClear(made, changed);
  return made;
}

// Answers of all videos; null while one is missing.
function arrayOf(values) {
  return values.includes(null) ? null : values;
}

// A slider counts only once it was touched; until then it shows no thumb.
class Slider {
  constructor(question, label, changed) {
    const {least, most} = question;
    this.labels = [...question.labels || []].reverse();  // they are listed from `most` down to `least`
    this.middle = String(Math.round((least + most) / 2));
    this.changed = changed;
    this.input = element('input', {type: 'range', min: least, max: most, step: 1});
    this.input.setAttribute('aria-label', label);
    this.number = element('span', {className: 'number'});
    this.number.setAttribute('aria-hidden', 'true');
    this.clear();
    for (const type of ['input', 'change', 'click']) this.input.addEventListener(type, () => this.touch());
    this.input.addEventListener('keydown', (event) => {
      if (event.key === ' ') event.preventDefault();
      if (event.key === ' ') this.touch();
    });
  }

  clear() {
    this.touched = false;
    this.input.value = this.middle;
    this.input.classList.add('untouched');
    this.input.setAttribute('aria-valuetext', say('not_set'));
    this.number.textContent = '–';
  }

  touch() {
    this.touched = true;
    this.input.classList.remove('untouched');
    this.input.setAttribute('aria-valuetext', this.spoken);
    this.number.textContent = this.input.value;
    this.changed();
  }

  // The number, and the label that is nearest; two labels alone name the ends.
  get spoken() {
    const {value, min, max} = this.input;
    const at = (value - min) / (max - min) * (this.labels.length - 1);
    return this.labels.length > 2 ? `${value}, ${this.labels[Math.round(at)]}` : value;
  }

  get value() {
    return this.touched ? Number(this.input.value) : null;
  }

  open() {
    return !this.touched;
  }

  get begun() {
    return this.touched;
  }

  pick() {
    return false;
  }
}

// `labels` stand from left to right.
function ticksOf(labels) {
  const ticks = element('div', {className: 'ticks', id: newId('ticks')});
  ticks.setAttribute('aria-hidden', 'true');
  ticks.style.setProperty('--columns-of-ticks', String(4 * Math.max(1, labels.length - 1)));
  ticks.style.setProperty('--ends', labels.length === 3 ? '4' : '5');
  ticks.classList.toggle('two', labels.length <= 2);
  labels.forEach((text, i) => {
    const tick = element('span', {className: 'tick', dir: 'auto'}, text);
    tick.style.setProperty('--i', String(i));
    ticks.append(tick, ' ');
  });
  return ticks;
}

function makeSliders(question, names, changed, place) {
  const field = fieldsetOf(question, 'sliders');
  field.dir = 'ltr';
  const texts = question.each ? names : [''];
  const lines = texts.map((name, i) => {
    const slider = new Slider(question, name ? `${question.text} ${name}` : question.text, changed);
    const line = element('div', {className: 'line'});
    if (name) line.append(element('div', {className: 'text'}, name));
    if (question.each) place(line, i);
    line.append(slider.input, slider.number);
    slider.element = line;
    return slider;
  });
  const [{labels}] = lines;
  if (labels.length > 0) {
    const line = element('div', {className: 'line'});
    const ticks = ticksOf(labels);
    if (question.each) line.append(element('div', {className: 'text'}));
    line.append(ticks, element('span', {className: 'number'}));
    field.append(line);
    for (const {input} of lines) input.setAttribute('aria-describedby', ticks.id);
  }
  field.append(...lines.map((line) => line.element));
  const value = () => (question.each ? arrayOf(lines.map((line) => line.value)) : lines[0].value);
  const made = {question, element: field, lines, value};
  made.refresh = offerToClear(made, changed);
  return made;
}

// Options are pressed from the best to the worst; pressing one again takes it out.
class Ranking {
  constructor(question, names, changed) {
    this.options = optionsOf(question, names);
    this.changed = changed;
    this.ranked = [];  // indices of options, the best first
    this.buttons = this.options.map((option, i) => {
      const button = element('button', {type: 'button', className: 'rank'});
      button.addEventListener('click', () => this.press(i));
      return button;
    });
    this.again = element('button', {type: 'button', className: 'plain'}, say('rank_again'));
    this.again.addEventListener('click', () => {
      this.ranked = [];
      this.refresh();
      this.changed();
    });
    this.element = element('div', {className: 'options', dir: question.of_videos ? 'ltr' : ''});
    this.element.style.setProperty('--options', String(columnsOf(this.options.length)));
    this.element.append(...this.buttons);
    this.refresh();
  }

  press(i) {
    this.ranked = this.ranked.includes(i) ? this.ranked.filter((other) => other !== i) : [...this.ranked, i];
    this.refresh();
    this.changed();
    announceChange(this.element);
  }

  refresh() {
    this.buttons.forEach((button, i) => {
      const option = this.options[i].text;
      const rank = this.ranked.indexOf(i) + 1;
      button.replaceChildren(element('span', {className: 'badge'}, rank ? String(rank) : ''), element('span', {}, option));
      button.setAttribute('aria-pressed', String(rank > 0));
      button.setAttribute('aria-label', rank ? say('rank_set', {option, n: rank}) : say('rank_open', {option}));
    });
    this.again.disabled = this.ranked.length === 0;
  }

  // Of each option its rank.
  get value() {
    if (this.open()) return null;
    return this.options.map((_, i) => this.ranked.indexOf(i) + 1);
  }

  open() {
    return this.ranked.length < this.options.length;
  }

  get begun() {
    return this.ranked.length > 0;
  }

  pick(n) {
    if (n < 1 || n > this.options.length) return false;
    this.press(n - 1);
    return true;
  }

  focus() {
    this.buttons[0].focus();
  }
}

function makeRank(question, names, changed) {
  const field = fieldsetOf(question, 'cards');
  const ranking = new Ranking(question, names, changed);
  const help = element('p', {className: 'help'}, say('rank_help'));
  help.append(' ', ranking.again);
  field.append(help, ranking.element);
  return {question, element: field, lines: [ranking], value: () => ranking.value};
}

function labelled(question, input) {
  const label = element('label', {className: 'field open'});
  label.append(questionText(question), input);
  return label;
}

function makeText(question, names, changed) {
  const area = element('textarea', {rows: 2, maxLength: 5000});
  area.addEventListener('input', changed);
  const value = () => area.value.trim() || null;
  return {question, element: labelled(question, area), lines: [], value};
}

// Where a question names no limit; as kFarthestNumber in study/record/answer_values.h.
const kFarthestNumber = 1e9;

function makeNumber(question, names, changed) {
  const {least, most} = question;
  const input = element('input', {type: 'number', step: 'any', inputMode: 'decimal', autocomplete: 'off'});
  if ([least, most].every((limit) => typeof limit === 'number')) input.placeholder = `${least}–${most}`;
  input.min = least ?? -kFarthestNumber;
  input.max = most ?? kFarthestNumber;
  input.addEventListener('input', changed);
  const limits = say('number_between', {least: input.min, most: input.max});
  const wrong = () => !input.validity.valid;
  const message = element('span', {className: 'wrong', id: newId('wrong')});
  input.setAttribute('aria-describedby', message.id);
  const refresh = () => {
    input.setAttribute('aria-invalid', String(wrong()));
    message.textContent = wrong() ? limits : '';
  };
  const problem = () => (wrong() ? `${question.text} – ${limits}` : '');
  const value = () => (input.value === '' || wrong() ? null : Number(input.value));
  const field = element('div', {className: 'field open'});
  field.append(labelled(question, input), message);
  return {question, element: field, lines: [], value, problem, refresh};
}

const kMakers = {rank: makeRank, text: makeText, number: makeNumber, slider: makeSliders};

function makeQuestions(group, names, changed, place) {
  const [first] = group;
  if (first.each && first.kind === 'rating') return [makeEach(first, names, changed, place)];
  const maker = kMakers[first.kind];
  return maker ? [maker(first, names, changed, place)] : makeGroup(group, names, changed);
}

// Whether an answer is missing: an optional one only where a part of it is given, which would be lost.
function isOpen({question, lines, value}) {
  return value() === null && (!question.optional || lines.some((line) => line.begun));
}

// ---- All questions of a page

class QuestionForm {
  // `names` of the figures from left to right. `place(element, i)` ties a line to the video of a place.
  // `seed` shuffles; null keeps the order.
  constructor(questions, {names = [], seed = null, changed = () => {}, place = () => {}}) {
    this.ids = questions.map((question) => question.id);  // in the study's order, shuffled or not
    this.made = [];
    const onChange = () => {
      this.refresh();
      changed();
    };
    for (const group of groupsOf(questions, seed)) this.made.push(...makeQuestions(group, names, onChange, place));
    for (const one of this.made) {
      if (one.element && !one.element.classList.contains('matrix')) one.element.dataset.question = one.question.id;
    }
    this.elements = this.made.map((one) => one.element).filter(Boolean);
    this.refresh();
  }

  get lines() {
    return this.made.flatMap((one) => one.lines);
  }

  // Marks the line that the next digit answers.
  refresh() {
    for (const one of this.made) {
      if (one.refresh) one.refresh();
    }
    const next = this.lines.length > 1 ? this.lines.find((line) => line.open()) : null;
    for (const line of this.lines) line.element.classList.toggle('current', line === next);
  }

  // How many questions must still be answered.
  get open() {
    return this.made.filter(isOpen).length;
  }

  // What else is wrong, in words.
  get problem() {
    for (const one of this.made) {
      const problem = one.problem ? one.problem() : '';
      if (problem) return problem;
    }
    return '';
  }

  get complete() {
    return this.open === 0 && this.problem === '';
  }

  values() {
    const given = new Map(this.made.map((one) => [one.question.id, one.value()]));
    return Object.fromEntries(this.ids.map((id) => [id, given.get(id)]));
  }

  reasons() {
    const given = this.made.filter((one) => one.reasons && one.reasons());
    return Object.fromEntries(given.map((one) => [one.question.id, one.reasons()]));
  }

  // A digit answers the line that has the focus, or else the first that is open.
  press(n) {
    const focused = this.lines.find((line) => line.element.contains(document.activeElement));
    const [only] = this.lines;
    const line = focused || this.lines.find((one) => one.open()) || (this.lines.length === 1 ? only : null);
    if (!line || !line.pick(n)) return false;
    if (focused) {
      const next = this.lines[this.lines.indexOf(focused) + 1];
      if (next && next.focus && next.open()) next.focus();
    }
    return true;
  }

  // How many answers the digits reach.
  get digits() {
    return Math.min(9, Math.max(0, ...this.lines.map((line) => (line.options ? line.options.length : 0))));
  }
}
