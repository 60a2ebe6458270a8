// Fields of the form. Each belongs to a JSON Pointer and has a place for the service's fault; `draft` keeps the value.

import {button, el} from './dom.js';

/** Entries of a list that have fields; a longer one is edited as JSON. */
const MOST_CARDS = 40;

export const idOf = at => `f${at.replaceAll('/', '-')}`;

/** A field: label, input, unit, and a place for what is wrong with it. */
function field(at, label, input, {unit, help} = {}) {
  const id = idOf(at);
  input.id = id;
  const told = [help && `${id}-help`, `${id}-fault`].filter(Boolean).join(' ');
  input.setAttribute('aria-describedby', told);
  return el(
    'div',
    {class: 'field', 'data-at': at},
    el('label', {for: id}, label, unit && el('span', {class: 'unit'}, ` ${unit}`)),
    input,
    help && el('p', {class: 'help', id: `${id}-help`}, help),
    el('p', {class: 'fault', id: `${id}-fault`}),
  );
}

/** A number; empty means that the field is left out, and `usual` is what holds then. */
export function number(draft, at, label, unit, {usual, help} = {}) {
  const input = el('input', {
    type: 'text',
    inputmode: 'decimal',
    autocomplete: 'off',
    value: draft.get(at) ?? '',
    placeholder: usual ?? '',
    oninput: () => {
      const text = input.value.trim(),
        value = Number(text.replace(',', '.'));
      // What is no number is sent as it is: the service says so, beside the field.
      draft.set(at, text === '' ? undefined : Number.isFinite(value) ? value : text);
    },
  });
  return field(at, label, input, {unit, help});
}

export function text(draft, at, label, {usual, help} = {}) {
  const input = el('input', {
    type: 'text',
    value: draft.get(at) ?? '',
    placeholder: usual ?? '',
    maxlength: 200,
    oninput: () => draft.set(at, input.value === '' ? undefined : input.value),
  });
  return field(at, label, input, {help});
}

/** Numbers of one row, such as coordinates, in one input. */
export function row(draft, at, label, unit, help) {
  const input = el('input', {
    type: 'text',
    autocomplete: 'off',
    value: (draft.get(at) ?? []).join(' '),
    oninput: () => draft.set(at, numbers(input.value)),
  });
  return field(at, label, input, {unit, help});
}

/** Points, one on a line. */
export function points(draft, at, label, help = 'x and y of one point on each line') {
  const input = el('textarea', {
    rows: 6,
    spellcheck: 'false',
    value: (draft.get(at) ?? []).map(point => point.join(' ')).join('\n'),
    oninput: () => {
      const lines = input.value.split('\n').filter(line => line.trim() !== '');
      draft.set(at, lines.length > 0 ? lines.map(numbers) : undefined);
    },
  });
  return field(at, label, input, {unit: 'm', help});
}

const numbers = text =>
  text
    .trim()
    .split(/[\s;,]+/)
    .filter(Boolean)
    .map(word => (Number.isFinite(Number(word)) ? Number(word) : word));

/** A choice of words; the first stands for the field left out where its value is undefined. */
export function choice(draft, at, label, options, {help} = {}) {
  const now = JSON.stringify(draft.get(at));
  const input = el(
    'select',
    {onchange: () => draft.set(at, options[input.selectedIndex][0])},
    options.map(([value, words]) => el('option', {selected: JSON.stringify(value) === now}, words)),
  );
  return field(at, label, input, {help});
}

export function tick(draft, at, label, {help, on = true} = {}) {
  const input = el('input', {
    type: 'checkbox',
    checked: isOn(draft.get(at)),
    onchange: () => draft.reshape(at, input.checked ? structuredClone(on) : undefined),
  });
  return box(at, label, input, help);
}

const isOn = value => (Array.isArray(value) ? value.length > 0 : value !== undefined && value !== false);

function box(at, label, input, help) {
  const id = idOf(at);
  input.id = id;
  input.setAttribute('aria-describedby', [help && `${id}-help`, `${id}-fault`].filter(Boolean).join(' '));
  return el(
    'div',
    {class: 'field', 'data-at': at},
    el('label', {class: 'check'}, input, ` ${label}`),
    help && el('p', {class: 'help', id: `${id}-help`}, help),
    el('p', {class: 'fault', id: `${id}-fault`}),
  );
}

/**
 * One of several shapes that a part of a request may have; each is {words, is, start}: whether the part has it, and what it begins as,
 * or what it makes of the part before. Choosing another shape replaces the part.
 */
export function shape(draft, at, label, shapes, {help} = {}) {
  const part = draft.get(at);
  const now = shapes.findIndex(({is}) => is(part));
  const input = el(
    'select',
    {onchange: () => draft.reshape(at, begun(shapes[input.value].start, draft.get(at)))},
    now < 0 && el('option', {value: -1, selected: true}, 'as in the JSON'),
    shapes.map(({words}, i) => el('option', {value: i, selected: i === now}, words)),
  );
  return field(`${at}#`, label, input, {help});
}

/** What a part begins as: given, or made of what is there. */
const begun = (start, now) => structuredClone(typeof start === 'function' ? start(now) : start);

/** A group of fields under a legend, with a place for faults of the whole. */
export function group(at, legend, ...children) {
  return el('fieldset', {class: 'group', 'data-at': at}, el('legend', {}, legend), children, el('p', {class: 'fault'}));
}

/** A list with entries to add and to remove; `entry` gives the fields of one. */
export function list(draft, at, {name, start, entry, least = 0}) {
  const entries = draft.get(at) ?? [];
  const remove = i => {
    const rest = entries.filter((_, k) => k !== i);
    draft.reshape(at, rest.length > 0 || least > 0 ? rest : undefined);
  };
  const cards = entries
    .slice(0, MOST_CARDS)
    .map((_, i) =>
      el(
        'fieldset',
        {class: 'card', 'data-at': `${at}/${i}`},
        el('legend', {}, `${name} ${i + 1}`),
        entry(`${at}/${i}`, i),
        entries.length > least && button(`Remove ${name.toLowerCase()} ${i + 1}`, () => remove(i), {class: 'small'}),
        el('p', {class: 'fault'}),
      ),
    );
  const add = () => draft.reshape(at, [...entries, begun(start, entries)]);
  const more = entries.length - cards.length;
  return [
    cards,
    more > 0 && el('p', {class: 'soft'}, `${more} more: see the JSON.`),
    button(`Add ${name.toLowerCase()}`, add, {id: `${idOf(at)}-add`, class: 'small'}),
  ];
}
