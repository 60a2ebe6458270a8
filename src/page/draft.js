// A request in the making, and what the service finds wrong with it.

import {faultsOf} from './api.js';
import {look, set} from './pointer.js';

const PAUSE = 250;

export class Draft {
  /** `changed` runs after every change, `reshaped` where fields come or go, `judged` with the faults of the service. */
  constructor(request, {changed, reshaped, judged}) {
    Object.assign(this, {request, changed, reshaped, judged, faults: null, left: new Map()});
  }

  get(at) {
    return look(this.request, at);
  }

  set(at, value) {
    set(this.request, at, value);
    this.touch();
  }

  /** Sets what other fields depend on. */
  reshape(at, value) {
    set(this.request, at, value);
    this.reshaped();
    this.touch();
  }

  replace(request) {
    this.request = request;
    this.reshaped();
    this.touch();
  }

  /** Goes on with another kind of structure: as it was left, or from a start. */
  change(kind, start) {
    for (const now of ['arch', 'bridge', 'blocks']) if (this.request[now]) this.left.set(now, this.request);
    this.replace(this.left.get(kind) ?? start);
  }

  touch() {
    this.changed();
    clearTimeout(this.timer);
    this.asking?.abort();
    this.timer = setTimeout(() => this.judge(), PAUSE);
  }

  /** Asks the service, and settles with the faults; with null where it was not answered, or was changed meanwhile. */
  async judge() {
    clearTimeout(this.timer);
    this.asking?.abort();
    const asking = (this.asking = new AbortController());
    try {
      const faults = await faultsOf(JSON.stringify(this.request), asking.signal);
      if (asking.signal.aborted) return null;
      this.faults = faults;
      this.judged(faults);
      return faults;
    } catch (error) {
      if (error.name !== 'AbortError') this.judged(null, error);
      return null;
    }
  }

  stop() {
    clearTimeout(this.timer);
    this.asking?.abort();
  }
}
