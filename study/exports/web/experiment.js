// Shows a study with jsPsych. What is shown is in study.js. Each answer is kept as soon as it is given: in this browser, so
// that a reload goes on where it was, and with DataPipe, if the export names an experiment there. At the end the answers
// are offered as a file of the form "chironomia answers 2"; they are in jsPsych's own data too. Its words are those of
// the study's own page, in texts.js.
'use strict';

const query = new URLSearchParams(location.search);
const jsPsych = initJsPsych({show_progress_bar: true, message_progress_bar: '', on_finish: finish});
const speaker = new Speaker(study.language, study.texts);

function say(name, values) {
  return escapeHtml(speaker.say(name, values));
}

// ---- What is kept

// A panel should have filled in {{%PROLIFIC_PID%}} (Prolific) or ${e://Field/PROLIFIC_PID} (Qualtrics); a link that was
// pasted names nobody.
function nameGiven() {
  const name = (query.get('PROLIFIC_PID') || query.get('p') || '').trim();
  return name.startsWith('{{%') || name.startsWith('${e://') ? '' : name;
}

// ?sheet=N gives a sheet, counted from 0 and after the last one from the first again, as in the study's own page; without
// it, or if it is no number, one is drawn.
const named = nameGiven();
const sheet = query.get('sheet') || '';
const kKey = `chironomia ${study.study} jspsych ${named} ${sheet}`;

function readKept() {
  try {
    return JSON.parse(localStorage.getItem(kKey));
  } catch {
    return null;
  }
}

const kept = Object.assign({
  participant: named || jsPsych.randomization.randomID(12),
  visit: jsPsych.randomization.randomID(8),  // of this browser, so that names of files are never the same
  sheet: /^\d{1,9}$/.test(sheet) ? Number(sheet) % study.sheets.length :
      jsPsych.randomization.randomInt(0, study.sheets.length - 1),
  started: new Date().toISOString(),
  finished: null,
  questionnaire: {},
  answers: [],
}, readKept());

function keep() {
  try {
    localStorage.setItem(kKey, JSON.stringify(kept));
  } catch {
    // private windows may refuse; the answers are in this page, and with DataPipe
  }
  deliver();
}

// ---- DataPipe (https://pipe.jspsych.org) writes each delivery into a file of its own: all answers so far

const kTries = 8;
let delivered = '';       // the last text that arrived
let delivering = null;    // the delivery that is under way
let refusedBy = '';       // why DataPipe takes nothing

function wait(seconds) {
  return new Promise((done) => setTimeout(done, seconds * 1000));
}

// Whether the answers arrived; a name that is there already is one whose acknowledgement was lost.
async function post(name, text) {
  const response = await fetch(study.pipe.url, {
    method: 'POST',
    headers: {'Content-Type': 'application/json', 'Accept': '*/*'},
    body: JSON.stringify({experimentID: study.pipe.experiment, filename: name, data: text}),
  });
  if (response.ok) return true;
  const {error} = await response.json().catch(() => ({}));
  if (error === 'OSF_FILE_EXISTS') return true;
  if (response.status === 400) refusedBy = error || `status ${response.status}`;
  return false;
}

async function deliverAll() {
  for (let tried = 0; tried < kTries && !refusedBy;) {
    const text = JSON.stringify(answers());
    if (text === delivered) return;
    const number = String(kept.answers.length + (kept.finished ? 1 : 0)).padStart(4, '0');
    const arrived = await post(`${kept.participant}-${kept.visit}-${number}.json`, text).catch(() => false);
    if (arrived) {
      delivered = text;
      tried = 0;
    } else {
      await wait(Math.min(30, 2 ** tried++));
    }
  }
}

function deliver() {
  if (!study.pipe || delivering || kept.answers.length === 0) return;
  delivering = deliverAll().finally(() => {
    delivering = null;
  });
}

function escapeHtml(text) {
  return text.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/>/g, '&gt;').replace(/"/g, '&quot;');
}

// ---- Videos side by side; answers are possible once all have been watched

function nameHtml(name) {
  return `<b style="flex: 1 1 0">${escapeHtml(name)}</b>`;
}

// One video may show both figures; their names stand above its halves.
function videosHtml(step) {
  const combined = step.addresses.length < step.names.length;
  const videos = step.addresses.map((address, place) => {
    const name = combined ? '' : step.names[place] || '';
    return `<figure style="flex: 0 1 ${study.width}px; min-width: 0; margin: 0">${name && nameHtml(name)}
       <video src="${escapeHtml(address)}" controls playsinline preload="auto" ${step.sound ? '' : 'muted'}
        aria-label="${say(name ? 'video_named' : 'video', {name})}" style="display: block; width: 100%"></video></figure>`;
  });
  const halves = combined ? `<div style="display: flex">${step.names.map(nameHtml).join('')}</div>` : '';
  return `${headingHtml(step)}${halves}
    <div style="display: flex; justify-content: center; gap: 1em">${videos.join('')}</div>
    <p>${escapeHtml(step.caption)}</p><p id="hint" role="status">${hintOf(videos.length)}</p>`;
}

function headingHtml(step) {
  const steps = study.sheets[kept.sheet];
  return `<h1 style="font-size: 1em">${say('page_of', {n: steps.indexOf(step) + 1, all: steps.length})}</h1>`;
}

// Why nothing can be answered yet.
function hintOf(videos) {
  return say(videos === 1 ? 'watch_one' : videos === 2 ? 'watch_both' : 'watch_all');
}

// A video is watched from its beginning to its end, at its own speed.
function holdBack(video) {
  let furthest = 0;  // [s]
  let watched = false;
  video.addEventListener('ended', () => { watched = true; });
  video.addEventListener('seeking', () => {
    if (!watched && video.currentTime > furthest + 0.3) video.currentTime = furthest;
  });
  video.addEventListener('timeupdate', () => {
    if (!video.seeking) furthest = Math.max(furthest, video.currentTime);
  });
  video.addEventListener('ratechange', () => {
    if (!watched && video.playbackRate !== 1) video.playbackRate = 1;
  });
}

// Two voices at once cannot be judged; silent videos may run together.
function silenceOthers(videos, playing) {
  if (playing.muted) return;
  for (const other of videos) {
    if (other !== playing) other.pause();
  }
}

function waitForVideos() {
  const videos = [...document.querySelectorAll('video')];
  const locked = [...document.querySelectorAll('button, input[type=submit], #questions')];
  const waiting = new Set(videos);
  locked.forEach((one) => { one.disabled = true; });
  for (const video of videos) {
    holdBack(video);
    video.addEventListener('play', () => silenceOthers(videos, video));
    video.addEventListener('ended', () => {
      waiting.delete(video);
      if (waiting.size > 0) return;
      locked.forEach((one) => { one.disabled = false; });
      document.getElementById('hint').innerHTML = say('answer_now');
    });
  }
}

// Reasons are asked for once there is an answer that needs some, and then there must be one.
function waitForReasons(questions) {
  for (const question of questions.filter((one) => one.reasons)) {
    const list = document.getElementById(`reasons-${question.id}`);
    const inputs = [...list.querySelectorAll('input')];
    const refresh = () => {
      const chosen = document.querySelector(`input[name="${question.id}"]:checked`);
      list.disabled = !needsReasons(question, chosen && Number(chosen.value));
      const given = inputs.some((input) => (input.type === 'checkbox' ? input.checked : input.value.trim() !== ''));
      inputs[0].setCustomValidity(list.disabled || given ? '' : speaker.say('give_reason'));
    };
    list.form.addEventListener('input', refresh);
    refresh();
  }
}

function needsReasons(question, value) {
  return value !== null && value !== question.reasons.unless;
}

// A slider rests in the middle; it has an answer, and with it a name, once somebody has touched it.
function waitForSliders() {
  for (const slider of document.querySelectorAll('input[type=range]')) {
    if (slider.dataset.needed) requireSlider(slider);
    for (const touch of ['input', 'pointerdown']) {
      slider.addEventListener(touch, () => {
        slider.name = slider.dataset.name;
        slider.setCustomValidity('');
      });
    }
  }
}

function requireSlider(slider) {
  if (!slider.name) slider.setCustomValidity(speaker.say('not_set'));
}

// An optional question of all videos is left open or answered for each of them: an answer to one asks for the others.
function waitForTheOthers(questions) {
  for (const question of questions.filter((one) => one.each && one.optional)) {
    const inputs = [...document.getElementById(`question-${question.id}`).querySelectorAll('input')];
    for (const input of inputs) {
      input.addEventListener('input', () => requireAll(inputs));
      if (input.type === 'range') input.addEventListener('pointerdown', () => requireAll(inputs));
    }
  }
}

function requireAll(inputs) {
  for (const input of inputs) {
    if (input.type === 'range') requireSlider(input);
    else input.required = true;
  }
}

// ---- Questions as parts of a form; the names of fields are the question, and the place after a dot

function radios(name, values, optional) {
  return values.map(([value, text]) =>
      labelHtml(`<input type="radio" name="${name}" value="${escapeHtml(String(value))}" ${optional ? '' : 'required'}>`,
                text)).join(' ');
}

// Whatever is as long as its line, a button stays beside its words.
function labelHtml(input, text) {
  return `<label style="display: inline-flex; align-items: baseline; gap: 0.3em; margin: 0.2em 0.5em; text-align: start">${input}
    <span>${escapeHtml(text)}</span></label>`;
}

function range(least, most) {
  return Array.from({length: most - least + 1}, (_, i) => least + i);
}

function pointsOf(rating) {
  return range(1, rating.points).map((point) => [point, `${point} ${rating.labels?.[point] || ''}`.trim()]);
}

// `labels` are the elements that name the field.
function fieldHtml(question, name, names, labels) {
  const needed = question.optional ? '' : 'required';
  switch (question.kind) {
    case 'preference': return radios(name, question.answers.map((text, i) => [i + 1, text]), question.optional);
    case 'rating':
      return radios(name, pointsOf(question), question.optional);
    case 'slider':
      return `<input type="range" data-name="${name}" data-needed="${needed}" min="${question.least}"
               max="${question.most}" aria-labelledby="${labels}" aria-describedby="labels-${name}" style="width: 100%">
              <div id="labels-${name}" style="display: flex; justify-content: space-between">
              ${[...question.labels || []].reverse().map((text) => `<span>${escapeHtml(text)}</span>`).join(' ')}</div>`;
    case 'choice':
      return radios(name, question.of_videos ? names.map((text, place) => [place, text]) :
          question.options.map((option) => [option.id, option.text]), question.optional);
    case 'number':
      return `<input type="number" step="any" name="${name}" aria-labelledby="${labels}" min="${question.least ?? ''}"
               max="${question.most ?? ''}" ${needed}>`;
    default:
      return `<textarea name="${name}" aria-labelledby="${labels}" rows="3" cols="50" style="max-width: 100%"
               ${needed}></textarea>`;
  }
}

function reasonsHtml(question) {
  if (!question.reasons) return '';
  const options = question.reasons.options.map((option) =>
      labelHtml(`<input type="checkbox" name="${question.id}.reason.${option.id}" value="1">`, option.text));
  if (question.reasons.other) {
    options.push(`<label style="display: inline-block">${escapeHtml(question.reasons.other)} <input type="text" name="${question.id}.other"></label>`);
  }
  return `<fieldset id="reasons-${question.id}" disabled style="border: 0"><legend>${escapeHtml(question.reasons.text)}</legend>
    ${options.join(' ')}</fieldset>`;
}

function questionHtml(question, names) {
  const id = `question-${question.id}`;
  const fieldOf = (name, place) => {
    const labels = `${id}-text ${id}-${place}`;
    return `<div role="group" aria-labelledby="${labels}" style="margin: 1em 0"><b id="${id}-${place}">${escapeHtml(name)}</b>
      ${fieldHtml(question, `${question.id}.${place}`, names, labels)}</div>`;
  };
  const fields = question.each ? names.map(fieldOf).join('') :
      `<p>${fieldHtml(question, question.id, names, `${id}-text`)}</p>`;
  const text = escapeHtml(question.text) + (question.optional ? ` (${say('optional')})` : '');
  return `<fieldset id="${id}" style="min-width: 0"><legend id="${id}-text">${text}</legend>
    ${fields}${reasonsHtml(question)}</fieldset>`;
}

// ---- From fields back to values

function valueOf(question, text) {
  if (text === undefined || text === '') return null;
  const isWord = question.kind === 'text' || (question.kind === 'choice' && !question.of_videos);
  return isWord ? text : Number(text);
}

// Of all videos; null where the question is left open.
function valueOfEach(question, fields, places) {
  const values = range(0, places - 1).map((place) => valueOf(question, fields[`${question.id}.${place}`]));
  return values.every((value) => value === null) ? null : values;
}

function valuesOf(questions, fields, places) {
  return Object.fromEntries(questions.map((question) => [question.id, question.each ?
      valueOfEach(question, fields, places) : valueOf(question, fields[question.id])]));
}

function reasonsOf(questions, fields, values) {
  const asked = questions.filter((question) => question.reasons && needsReasons(question, values[question.id]));
  return Object.fromEntries(asked.map((question) => [question.id, {
    chosen: question.reasons.options.map((option) => option.id).filter((id) => fields[`${question.id}.reason.${id}`]),
    other: (fields[`${question.id}.other`] || '').trim(),
  }]));
}

// ---- The timeline

function answerOf(step, values, reasons, milliseconds) {
  return {page: step.page, pass: step.pass, videos: step.videos, values, reasons, skipped: false,
          seconds: Math.round(milliseconds) / 1000, events: []};
}

function keepAnswer(data, answer) {
  data.answer = answer;
  kept.answers.push(answer);
  keep();
}

// One question that is answered by pressing one of a few buttons.
function buttonsOf(step, questions) {
  const question = questions[0];
  if (questions.length !== 1 || question.each || question.reasons || question.optional) return null;
  if (question.kind === 'preference') return question.answers.map((text, i) => [i + 1, text]);
  if (question.kind === 'rating' && step.videos.length === 1) {
    return pointsOf(question);
  }
  return null;
}

// A video that stands alone has no name of its own.
function namesOf(step) {
  return range(0, step.places - 1).map((place) => step.names[place] || speaker.say('video'));
}

function trialOf(step) {
  const questions = step.questions.map((index) => study.questions[index]);
  const buttons = buttonsOf(step, questions);
  const single = step.videos.length === 1 && step.places === 1 && step.sound;
  const pressed = buttons && {
    choices: buttons.map(([, text]) => escapeHtml(text)),
    on_finish: (data) => keepAnswer(data, answerOf(step, {[questions[0].id]: buttons[data.response][0]}, {}, data.rt)),
  };
  if (buttons && single) {
    return {...pressed, type: jsPsychVideoButtonResponse, stimulus: step.addresses, width: study.width,
            prompt: `${headingHtml(step)}<p>${hintOf(1)}</p><p>${escapeHtml(questions[0].text)}</p>`,
            response_allowed_while_playing: false,
            response_ends_trial: true, trial_ends_after_video: false};
  }
  if (buttons) {
    return {...pressed, type: jsPsychHtmlButtonResponse, stimulus: videosHtml(step),
            prompt: `<p>${escapeHtml(questions[0].text)}</p>`, on_load: waitForVideos};
  }
  return {
    type: jsPsychSurveyHtmlForm,
    button_label: speaker.say('next'),
    html: `${videosHtml(step)}<fieldset id="questions" style="border: 0; min-width: 0">
      ${questions.map((question) => questionHtml(question, namesOf(step))).join('')}</fieldset>`,
    on_load: () => {
      waitForVideos();
      waitForSliders();
      waitForTheOthers(questions);
      waitForReasons(questions);
    },
    on_finish: (data) => {
      const values = valuesOf(questions, data.response, step.places);
      keepAnswer(data, answerOf(step, values, reasonsOf(questions, data.response, values), data.rt));
    },
  };
}

function textPage(html, button) {
  return {type: jsPsychHtmlButtonResponse, stimulus: `<h1>${escapeHtml(study.title)}</h1><p>${html}</p>`, choices: [button]};
}

function timelineOf(steps) {
  const timeline = [];
  // A page that was opened as a file may not load videos ahead.
  if (location.protocol !== 'file:') {
    timeline.push({type: jsPsychPreload, video: [...new Set(steps.flatMap((step) => step.addresses))],
                   continue_after_error: true, max_load_time: 60000});
  }
  if (study.consent && kept.answers.length === 0) {
    timeline.push(textPage(study.consent, study.agreement ? escapeHtml(study.agreement) : say('agree')));
  }
  timeline.push(textPage(study.instructions, say(kept.answers.length === 0 ? 'begin' : 'go_on')));
  timeline.push(...steps.map(trialOf));
  if (study.questionnaire.length > 0) {
    timeline.push({
      type: jsPsychSurveyHtmlForm,
      button_label: speaker.say('finish'),
      html: `<h1 style="font-size: 1em">${say('questionnaire_title')}</h1>
        ${study.questionnaire.map((question) => questionHtml(question, [''])).join('')}`,
      on_load: waitForSliders,
      on_finish: (data) => {
        data.questionnaire = valuesOf(study.questionnaire, data.response, 1);
        kept.questionnaire = data.questionnaire;
        keep();
      },
    });
  }
  return timeline;
}

// ---- The end

function answers() {
  return {
    format: 'chironomia answers 2', study: study.study, participant: kept.participant, sheet: kept.sheet,
    simulated: false, started: kept.started, finished: kept.finished, browser: navigator.userAgent,
    arrived_with: Object.fromEntries(query), questionnaire: kept.questionnaire, answers: kept.answers,
  };
}

async function finish() {
  kept.finished ??= new Date().toISOString();
  await delivering;
  keep();
  const place = jsPsych.getDisplayElement() || document.body;
  if (delivering) place.innerHTML = `<p role="status">${say('saving')}</p>`;
  await delivering;
  const text = JSON.stringify(answers(), null, 1);
  const stored = study.pipe && delivered === JSON.stringify(answers());
  const file = new Blob([text], {type: 'application/json'});
  const lost = study.pipe && !stored ? `<p id="not-stored">${say('refused_title')}.
    ${refusedBy ? say('refused', {error: refusedBy}) : say('finish_file')}</p>` : '';
  const link = `<p><a id="save" download="answers-${escapeHtml(kept.participant)}.json"
    href="${URL.createObjectURL(file)}">${say('save')}</a></p>`;
  const next = study.completion_url ? `<p><a href="${escapeHtml(study.completion_url)}">${say('complete')}</a></p>` : '';
  const code = study.completion_code ?
      `<p>${say('code')} <b id="code">${escapeHtml(study.completion_code)}</b></p>` : '';
  place.innerHTML = `<h1>${say('finish_title')}</h1>${lost}${link}${code}${next}`;
}

// Participants who have finished see the end again; all others go on where they were.
if (kept.finished) {
  addEventListener('load', finish);
} else {
  jsPsych.run(timelineOf(study.sheets[kept.sheet].slice(kept.answers.length)));
}
