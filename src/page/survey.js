// A request from a file: JSON as it is, or a CSV of points surveyed on an arch, with the columns x_m and y_m, `side` where
// there are points of both faces, and `tolerance_m` where points are uncertain.

import {STARTERS} from './starters.js';

/** A file that cannot be read as either, and why. */
export class BadFile extends Error {}

/** The request that a file describes. */
export async function requestFrom(file) {
  const text = await file.text();
  if (/^\s*[{[]/.test(text)) {
    try {
      return JSON.parse(text);
    } catch (error) {
      throw new BadFile(`${file.name} begins like JSON, but is none: ${error.message}.`);
    }
  }
  return surveyed(text, file.name);
}

/** An arch with a joint at every pair of points; without points on the extrados a thickness is still to be given. */
export function surveyed(text, name = 'The file') {
  const lines = text
    .split(/\r?\n/)
    .map((line, i) => [i + 1, line.trim()])
    .filter(([, line]) => line !== '');
  const separator = lines[0]?.[1].includes(';') ? ';' : ',';
  const cells = line => line.split(separator).map(cell => cell.trim().replace(/^"|"$/g, ''));
  const columns = lines.length > 0 ? cells(lines[0][1].toLowerCase()) : [];
  const [side, x, y, tolerance] = ['side', 'x_m', 'y_m', 'tolerance_m'].map(column => columns.indexOf(column));
  if (Math.min(x, y) < 0) throw new BadFile(`${name} has no columns x_m and y_m: name them in its first line.`);
  const points = {intrados: [], extrados: []};
  for (const [number, line] of lines.slice(1)) {
    const row = cells(line),
      face = points[side < 0 ? 'intrados' : row[side]?.toLowerCase()],
      read = cell => Number(cell.replace(separator === ';' ? ',' : ' ', '.'));
    if (!face) throw new BadFile(`${name}, line ${number}: side is “${row[side]}”; write intrados or extrados.`);
    const at = [x, y].map(column => read(row[column] || 'none')),
      uncertain = read(row[tolerance] || '0');
    if (![...at, uncertain].every(Number.isFinite))
      throw new BadFile(`${name}, line ${number}: x_m, y_m and tolerance_m have to be numbers, in m.`);
    face.push({at, uncertain});
  }
  if (points.intrados.length < 3)
    throw new BadFile(`${name} has ${points.intrados.length} points on the intrados: three are the least.`);
  const [intrados, extrados] = [points.intrados, points.extrados].map(fromTheLeft);
  if (extrados.length > 0 && extrados.length !== intrados.length) {
    throw new BadFile(
      `${name} has ${intrados.length} points on the intrados and ${extrados.length} on the extrados: give one pair for each joint.`,
    );
  }
  const lists = of =>
    extrados.length > 0 ? {intrados_m: intrados.map(of), extrados_m: extrados.map(of)} : {intrados_m: intrados.map(of)};
  return requestOf(
    lists(point => point.at),
    tolerance < 0 ? null : lists(point => point.uncertain),
    name,
  );
}

/** As surveyed, but begun at the left springing. */
const fromTheLeft = points => (points[0]?.at[0] > points.at(-1)?.at[0] ? [...points].reverse() : points);

function requestOf(profile, tolerances, name) {
  const xs = profile.intrados_m.map(([x]) => x);
  const quarter = Number((xs[0] + (xs.at(-1) - xs[0]) / 4).toPrecision(4));
  const {
    loads: [weight],
    load_factor,
    report,
    mesh,
  } = structuredClone(STARTERS.arch.request);
  const load = {load: {point_load: {force_n_per_m: 1000, x_m: quarter}}, scaled: true};
  return {
    name: name.replace(/\.csv$/i, ''),
    arch: {profile: {surveyed: profile}},
    ...(tolerances && {analysis: {survey_tolerance: tolerances}}),
    loads: [weight, load],
    load_factor,
    mesh,
    report,
  };
}
