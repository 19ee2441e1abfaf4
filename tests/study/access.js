// What a program can see of a page's access: controls without a name, and texts that are too pale for their ground.
'use strict';

const access = {
  visible(element) {
    return element.checkVisibility({visibilityProperty: true, opacityProperty: true}) && !element.closest('.unseen');
  },

  nameless() {
    const controls = [...document.querySelectorAll('button, a, input, textarea, video, progress, dialog[open], [role=radiogroup]')];
    const named = (control) => {
      const labels = [...(control.labels || [])].map((label) => label.textContent);
      const by = (control.getAttribute('aria-labelledby') || '').split(' ').map((id) => byId(id)?.textContent || '');
      return [control.textContent, control.getAttribute('aria-label'), ...labels, ...by].join('').trim() ||
        control.getAttribute('aria-hidden');
    };
    return controls.filter((control) => access.visible(control) && !named(control)).map((one) => one.outerHTML);
  },

  // Relative luminance and contrast as WCAG 2.1 defines them.
  luminance(colour) {
    const [r, g, b] = colour.match(/[\d.]+/g).map(Number).map((level) => {
      const part = level / 255;
      return part <= 0.03928 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  },

  ground(element) {
    for (let one = element; one; one = one.parentElement) {
      const colour = getComputedStyle(one).backgroundColor;
      if (!colour.startsWith('rgba(0, 0, 0, 0')) return colour;
    }
    return 'rgb(255, 255, 255)';
  },

  // Elements whose own text has less than 4.5 : 1.
  pale() {
    return [...document.querySelectorAll('body *')].filter((element) => {
      const own = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent.trim());
      if (!own || !access.visible(element)) return false;
      const [a, b] = [getComputedStyle(element).color, access.ground(element)].map(access.luminance);
      return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5;
    }).map((element) => `${element.textContent} ${getComputedStyle(element).color} on ${access.ground(element)}`);
  },
};
