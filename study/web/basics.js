// What all parts of the page use: the study's data, its texts, and elements.
'use strict';

const study = JSON.parse(document.getElementById('pages').textContent);
const speaker = new Speaker(study.language, study.texts);
const byId = (id) => document.getElementById(id);

function say(name, values) {
  return speaker.say(name, values);
}

function element(name, properties = {}, text = '') {
  const made = Object.assign(document.createElement(name), properties);
  if (text) made.textContent = text;
  return made;
}

// Replaces {name} in a text by elements, such as keys.
function fillIn(text, elements) {
  return text.split(/(\{\w+\})/).map((part) => elements[part.slice(1, -1)] || part);
}

function wait(seconds) {
  return new Promise((done) => setTimeout(done, seconds * 1000));
}

// The event, once.
function once(target, type) {
  return new Promise((done) => target.addEventListener(type, done, {once: true}));
}

// A form that is sent when `complete()` says so; the event of a form that is not complete is ignored.
async function submitted(form, complete) {
  for (;;) {
    const event = await new Promise((done) => form.addEventListener('submit', (given) => {
      given.preventDefault();
      done(given);
    }, {once: true}));
    if (complete(event)) return;
  }
}

// Shows one section and hides all others; the focus goes to its heading, so that readers begin there.
function show(id) {
  for (const section of document.querySelectorAll('main > section')) section.hidden = section.id !== id;
  if (id !== 'trial') byId('progress').hidden = true;
  document.body.classList.toggle('watching', id === 'trial');
  focusHeading();
  scrollTo(0, 0);
}

function focusHeading() {
  document.querySelector('main > section:not([hidden]) h2')?.focus({preventScroll: true});
}
