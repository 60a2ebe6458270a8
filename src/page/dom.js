// Builds elements. Text is always a text node: nothing here reads HTML.

const SVG = 'http://www.w3.org/2000/svg';
// Set as properties, since their attributes only say how they begin.
const PROPERTIES = new Set(['value', 'checked', 'selected', 'disabled']);

/** el('p', {class: 'soft', onclick: f}, 'text', child); what is null, undefined or false is left out. */
export function el(name, attributes = {}, ...children) {
  return fill(document.createElement(name), attributes, children);
}

export function svg(name, attributes = {}, ...children) {
  return fill(document.createElementNS(SVG, name), attributes, children);
}

function fill(node, attributes, children) {
  node.append(...children.flat(Infinity).filter(there));
  for (const [key, value] of Object.entries(attributes)) {
    if (!there(value)) continue;
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (PROPERTIES.has(key)) node[key] = value;
    else node.setAttribute(key, value === true ? '' : value);
  }
  return node;
}

function there(value) {
  return value !== null && value !== undefined && value !== false;
}

/** Replaces what a node contains. */
export function put(node, ...children) {
  node.replaceChildren(...children.flat(Infinity).filter(there));
  return node;
}

/** Tells those who listen to a screen reader. */
export function say(text) {
  document.getElementById('said').textContent = text;
}

/** Tells everybody that something did not work, until the next view. */
export function complain(text) {
  const told = document.getElementById('told');
  told.textContent = text;
  told.hidden = text === '';
}

/** Hands bytes over as a file. */
export function save(name, blob) {
  const url = URL.createObjectURL(blob);
  const link = el('a', {href: url, download: name});
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

/** A button; every one has its words. */
export function button(words, onclick, more = {}) {
  return el('button', {type: 'button', onclick, ...more}, words);
}

/** A table of rows of cells under headings; cells that begin with a number stand to the right. */
export function table(headings, rows, caption) {
  return el(
    'table',
    {},
    caption && el('caption', {class: 'unseen'}, caption),
    el(
      'thead',
      {},
      el(
        'tr',
        {},
        headings.map(text => el('th', {scope: 'col'}, text)),
      ),
    ),
    el(
      'tbody',
      {},
      rows.map(row =>
        el(
          'tr',
          {},
          row.map(cell => el('td', typeof cell === 'number' || /^[−\d]/.test(cell) ? {class: 'number'} : {}, cell)),
        ),
      ),
    ),
  );
}
