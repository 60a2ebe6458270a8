// A slider over stops, with a button that plays them.

import {button, el} from './dom.js';

const STOP_MS = 45;

/** {node, use(texts, index)}; `moved(index)` runs whenever the slider stands elsewhere. */
export function player(moved) {
  const slider = el('input', {
    type: 'range',
    min: 0,
    max: 0,
    step: 1,
    id: 'slider',
    'aria-label': 'Along the load path and through the collapse',
  });
  const told = el('output', {for: 'slider', class: 'told'}, ' ');
  let texts = [''],
    timer = null;

  const stand = () => {
    const index = Number(slider.value);
    told.textContent = texts[index];
    slider.setAttribute('aria-valuetext', texts[index]);
    moved(index);
  };
  const stop = () => {
    clearInterval(timer);
    timer = null;
    play.textContent = 'Play';
  };
  const step = () => {
    if (!slider.isConnected || Number(slider.value) >= Number(slider.max)) return stop();
    slider.value = Number(slider.value) + 1;
    stand();
  };
  const play = button(
    'Play',
    () => {
      if (timer) return stop();
      if (slider.value === slider.max) slider.value = 0;
      play.textContent = 'Stop';
      timer = setInterval(step, STOP_MS);
    },
    {class: 'small', id: 'play'},
  );
  slider.addEventListener('input', () => {
    stop();
    stand();
  });
  const node = el('div', {class: 'player'}, play, slider, told);
  return {
    node,
    use(all, index) {
      stop();
      texts = all;
      slider.max = all.length - 1;
      slider.value = index;
      node.hidden = all.length < 2;
      stand();
    },
  };
}
