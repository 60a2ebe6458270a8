// What a request describes, as polygons to draw: {stones, ground}; null where it is not complete. Forms are those of docs/reference.md.

import {bridgeOutline} from './spans.js';
import {profileOf} from './profile.js';
import {along, joints, stations, stonesBetween, surveyedJoints} from './ring.js';

export function outline(request) {
  try {
    const drawn = request.arch
      ? archOutline(request.arch)
      : request.bridge
        ? bridgeOutline(request.bridge)
        : blocksOutline(request.blocks);
    return drawn?.stones.flat(2).every(Number.isFinite) && drawn.ground.flat(2).every(Number.isFinite) ? drawn : null;
  } catch {
    // Half a request may be anything; the service says what is wrong with it.
    return null;
  }
}

function archOutline(arch) {
  const ends = arch.profile?.surveyed ? surveyed(arch.profile.surveyed) : setOut(arch);
  if (!ends) return null;
  const stones = arch.half ? leftHalf(ends) : stonesBetween(ends);
  const ground = [ends[0], ...(arch.half ? [] : [ends.at(-1)])];
  if (!(arch.abutments?.height_m > 0)) return {stones, ground};
  const below = ground.map((joint, end) => abutment(joint, end ? 1 : -1, arch.abutments.height_m));
  return {stones: [...stones, ...below], ground: below.map(([a, b]) => [a, b])};
}

function surveyed({intrados_m: inner, extrados_m: outer, thickness_m: thickness}) {
  if (!(inner?.length >= 3)) return null;
  if (outer) return inner.length === outer.length ? inner.map((point, k) => [point, outer[k]]) : null;
  return thickness > 0 ? surveyedJoints(inner, thickness) : null;
}

function setOut(arch) {
  const profile = profileOf(arch.profile);
  const {thickness = {}, voussoirs: count, line} = arch;
  if (!profile || !(count >= 2 && count <= 2001)) return null;
  const circle = thickness.extrados_circle;
  const [crown, springing] = thickness.linear
    ? [thickness.linear.crown_m, thickness.linear.springing_m]
    : [thickness.constant_m, thickness.constant_m];
  if (!circle && !(crown > 0 && springing > 0)) return null;
  const whole = [crown, springing],
    half = [crown / 2, springing / 2],
    none = [0, 0];
  const ring = {
    profile,
    inner: circle || line === 'intrados' ? none : half,
    outer: circle ? none : line === 'intrados' ? whole : half,
    circle: circle && {centre: [0, circle.centre_y_m], radius: circle.radius_m},
    centre: arch.joints?.rays?.centre_m,
  };
  return joints(ring, stations(profile.length, arch.relative_lengths ?? Array(count).fill(1)));
}

/** Stones of the left half; a keystone is cut on the axis. */
function leftHalf(ends) {
  const count = ends.length - 1;
  const stones = stonesBetween(ends.slice(0, Math.floor(count / 2) + 1));
  if (count % 2 === 0) return stones;
  const [[a, d], [b, c]] = [ends[(count - 1) / 2], ends[(count + 1) / 2]];
  return [...stones, [a, [0, (a[1] + b[1]) / 2], [0, (c[1] + d[1]) / 2], d]];
}

/** A rectangle under a springing joint; its first two corners stand on the ground. */
function abutment([a, b], side, height) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  const away = [(side * (a[1] - b[1])) / length, (side * (b[0] - a[0])) / length].map(t => -t);
  return [along(a, height, away), along(b, height, away), b, a];
}

function blocksOutline({polygons, supports = []}) {
  const stones = polygons.map(({corners_m: corners}) => corners).filter(corners => corners?.length >= 3);
  const lines = supports.flatMap(support => support.segments_m ?? []);
  const sides = supports
    .flatMap(support => support.sides ?? [])
    .map(({block, side}) => {
      const corners = polygons.find(polygon => polygon.name === block).corners_m;
      return [corners[side], corners[(side + 1) % corners.length]];
    });
  return stones.length > 0 ? {stones, ground: [...lines, ...sides]} : null;
}
