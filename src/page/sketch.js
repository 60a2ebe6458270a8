// The structure of a request: its stones, ground and fill, and its loads, which can be dragged where the request is a draft.

import {arrows, levels, places} from './arrows.js';
import {outline} from './outline.js';
import {el} from './dom.js';
import {idOf} from './fields.js';
import {View, middleOf} from './view.js';

export class Sketch {
  /** Of a draft, or of anything with a `request` that stays as it is. */
  constructor(draft) {
    this.draft = draft;
    this.movable = draft.set && ((place, point) => this.move(place, point));
    const words = this.movable ? ' Loads with a handle move with the pointer or the arrow keys.' : '';
    this.view = new View(`Drawing of the structure.${words}`, view => this.paint(view));
    this.old = el(
      'p',
      {class: 'old soft', hidden: true},
      'Some size is missing or cannot be: this is how it was before.',
    );
    this.view.node.append(this.old);
    this.refresh();
  }

  /** After every change of the draft. */
  refresh() {
    const drawn = outline(this.draft.request);
    this.old.hidden = drawn !== null;
    this.drawn = drawn ?? this.drawn;
    if (drawn && !this.dragging) this.view.show([...drawn.stones.flat(), ...drawn.ground.flat()], 0.12);
    this.view.redraw();
  }

  paint(view) {
    if (!this.drawn) return view.marks.replaceChildren();
    const {stones, ground} = this.drawn,
      {request} = this.draft;
    view.lines(levels(request, [view.box[0], view.box[2]]), {stroke: view.colours.soft, dash: [6, 4], width: 1});
    view.polygons(stones, {fill: view.colours.stone, stroke: view.colours.edge, alpha: this.old.hidden ? 1 : 0.4});
    view.ground(ground, middleOf(stones));
    const focused = document.activeElement?.id;
    view.mark(arrows(view, places(request, stones), this.movable));
    if (focused?.startsWith('load-')) document.getElementById(focused)?.focus();
  }

  move({pointer, both}, point) {
    // The view keeps its scale while a load moves.
    this.dragging = true;
    this.draft.set(pointer, both ? point : point[0]);
    this.dragging = false;
    const field = document.getElementById(idOf(pointer));
    if (field) field.value = both ? point.join(' ') : point[0];
  }
}
