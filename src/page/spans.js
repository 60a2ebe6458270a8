// A bridge as polygons to draw: rings, piers, abutments and backing.

import {profileOf} from './profile.js';
import {joints, stations, stonesBetween} from './ring.js';

export function bridgeOutline({spans, piers = [], abutments = {}, backing}) {
  const rings = spans.map(spanRings);
  if (rings.some(span => span === null) || piers.length !== spans.length - 1) return null;
  place(rings, piers);
  const springings = rings.map(span => [0, 1].map(end => springing(span, end)));
  const standing = piers.map((pier, j) => pierStones(pier, springings[j][1], springings[j + 1][0]));
  const ends = [0, 1].map(end => endBlock(end ? abutments?.right : abutments?.left, springings.at(-end)[end], end));
  const stones = [
    ...rings.flat().flatMap(stonesBetween),
    ...standing.flat(),
    ...ends.filter(Boolean).map(({stone}) => stone),
  ];
  if (Number.isFinite(backing?.level_m)) stones.push(...fills(rings, ends, springings, backing.level_m));
  const ground = [
    ...standing.map(([lowest]) => [lowest[0], lowest[1]]),
    ...ends.map((block, end) => (block ? block.bed : [springings.at(-end)[end][0], springings.at(-end)[end].at(-1)])),
  ];
  return {stones, ground};
}

/** The joints of every ring of a span about its own middle. */
function spanRings({profile, rings}) {
  const line = profileOf(profile);
  if (!line || !(rings?.length > 0)) return null;
  let below = [0, 0];
  const out = rings.map(({thickness_m: crown, springing_thickness_m: springing, voussoirs}) => {
    if (!(crown > 0 && voussoirs >= 1 && voussoirs <= 2001)) return null;
    const outer = [below[0] + crown, below[1] + (springing ?? crown)];
    const inner = below.map(depth => -depth);
    below = outer;
    return joints({profile: line, inner, outer}, stations(line.length, Array(voussoirs).fill(1)));
  });
  return out.every(Boolean) ? out : null;
}

/** Moves every span to its place; x = 0 lies between the first springing and the last. */
function place(spans, piers) {
  const widths = spans.map(([lowest]) => lowest.at(-1)[0][0] - lowest[0][0][0]);
  const sum = list => list.reduce((a, b) => a + b, 0);
  let left = -(sum(widths) + sum(piers.map(pier => pier.top_width_m))) / 2;
  spans.forEach((rings, j) => {
    const by = left + widths[j] / 2;
    for (const ends of rings.flat()) for (const point of ends) point[0] += by;
    left += widths[j] + (piers[j]?.top_width_m ?? 0);
  });
}

/** From the intrados of the lowest ring outwards. */
function springing(rings, end) {
  const joint = ring => ring.at(end ? -1 : 0);
  return [joint(rings[0])[0], ...rings.map(ring => joint(ring)[1])];
}

function pierStones({height_m: height, courses = 1, batter = 0}, left, right) {
  const at = k => {
    const y = (height / courses) * k - height;
    return [
      [left[0][0] + batter * y, y],
      [right[0][0] - batter * y, y],
    ];
  };
  return Array.from({length: Math.min(courses, 2001)}, (_, k) =>
    k + 1 < courses ? [...at(k), ...at(k + 1).reverse()] : [...at(k), ...right, ...[...left].reverse()],
  );
}

/** An abutment under a springing, with its bed and its back; null where the arch stands on the ground. */
function endBlock(abutment, points, end) {
  if (!(abutment?.height_m > 0)) return null;
  const out = end ? 1 : -1,
    face = points[0][0],
    outer = points.at(-1);
  const back = face + out * (abutment.width_m ?? Math.abs(outer[0] - face));
  const bed = [
    [back, -abutment.height_m],
    [face, -abutment.height_m],
  ];
  return {stone: [...bed, ...points, [back, outer[1]]], bed, back};
}

/** Backing over every springing, from the extrados up to a level. */
function fills(spans, ends, springings, level) {
  const haunch = (rings, end) => {
    const outer = rings.at(-1).map(joint => joint[1]);
    const points = [];
    for (const point of end ? outer.reverse() : outer) {
      const last = points.at(-1);
      if (point[1] >= level) {
        const share = last && (level - last[1]) / (point[1] - last[1]);
        return last ? [...points, [last[0] + share * (point[0] - last[0]), level]] : [];
      }
      points.push(point);
    }
    return [];
  };
  return Array.from({length: spans.length + 1}, (_, gap) => {
    const left = gap > 0 ? haunch(spans[gap - 1], 1) : [];
    const right = gap < spans.length ? haunch(spans[gap], 0) : [];
    const back = end => ends[end]?.back ?? springings.at(-end)[end].at(-1)[0];
    if (gap === 0) return [[back(0), level], [back(0), right[0]?.[1] ?? level], ...right];
    if (gap === spans.length) return [...left.reverse(), [back(1), left.at(-1)?.[1] ?? level], [back(1), level]];
    return [...left.reverse(), ...right];
  }).filter(polygon => polygon.length > 3);
}
