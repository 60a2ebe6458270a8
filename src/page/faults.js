// Puts every fault beside the field that it is about; what belongs to no field stands in a list of its own.

import {el, put} from './dom.js';
import {nearest} from './pointer.js';

/** Shows these faults in the form; `rest` takes those without a field. */
export function show(form, rest, faults) {
  const places = new Map();
  for (const node of form.querySelectorAll('[data-at]')) {
    const at = node.dataset.at.replace(/#$/, '');
    // Of two places for one pointer the field itself takes it.
    if (!places.has(at) || node.classList.contains('field')) places.set(at, node);
  }
  for (const node of form.querySelectorAll('[data-at]')) tell(node, []);
  const pointers = [...places.keys()],
    told = new Map(),
    homeless = [];
  for (const fault of faults) {
    const at = nearest(pointers, fault.pointer);
    if (at === undefined) homeless.push(fault);
    else
      told.set(at, [
        ...(told.get(at) ?? []),
        at === fault.pointer ? fault.detail : `${fault.pointer.slice(at.length + 1)}: ${fault.detail}`,
      ]);
  }
  for (const [at, details] of told) tell(places.get(at), details);
  put(
    rest,
    homeless.map(({pointer, detail}) => el('li', {}, pointer && el('code', {}, pointer), pointer && ' ', detail)),
  );
}

function tell(node, details) {
  const slot = [...node.children].findLast(child => child.classList.contains('fault'));
  const words = details.join(' ');
  if (slot && slot.textContent !== words) slot.textContent = words;
  const input = node.classList.contains('field') ? node.querySelector('input, select, textarea') : null;
  if (details.length > 0) input?.setAttribute('aria-invalid', 'true');
  else input?.removeAttribute('aria-invalid');
}

/** Moves to the first field that has a fault. */
export function toFirst(form) {
  const input = form.querySelector('[aria-invalid]');
  input?.closest('details')?.setAttribute('open', '');
  input?.focus();
}
