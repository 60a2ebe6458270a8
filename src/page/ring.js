// Joints of a ring: where they leave its intrados and its extrados. What cannot be set out is null.

const dot = (a, b) => a[0] * b[0] + a[1] * b[1];
const cross = (a, b) => a[0] * b[1] - a[1] * b[0];
const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
/** a + k b */
export const along = (a, k, b) => [a[0] + k * b[0], a[1] + k * b[1]];
/** Towards the extrados. */
const outward = ({tangent: [x, y]}) => [-y, x];

/** Arc lengths of joints that divide a line in these proportions. */
export function stations(total, lengths) {
  const sum = lengths.reduce((a, b) => a + b, 0);
  let before = 0;
  const at = lengths.map(length => {
    before += length;
    const sigma = (total / 2) * ((2 * before - sum) / sum);
    return Math.abs(sigma) < 1e-12 * total ? 0 : sigma;
  });
  return [-total / 2, ...at];
}

/**
 * The ends [intrados, extrados] of the joints at `at`. The ring is {profile, inner, outer, circle, centre}: depths below and above the
 * profile at the crown and at the springing; or the circle that is its extrados; a centre where the joints are rays.
 */
export function joints(ring, at) {
  const ends = at.map(sigma => jointAt(ring, sigma));
  return ends.every(pair => pair?.flat().every(Number.isFinite)) ? ends : null;
}

function jointAt(ring, sigma) {
  const place = ring.profile.at(sigma);
  if (ring.centre) {
    const arm = minus(place.point, ring.centre);
    if (dot(arm, outward(place)) <= 0) return null;
    return ray(
      ring,
      sigma,
      place.point,
      arm.map(a => a / Math.hypot(...arm)),
    );
  }
  if (sigma === 0 && ring.profile.hasApex) return ray(ring, sigma, place.point, [0, 1]);
  const [inner, outer] = depths(ring, Math.abs(sigma));
  const normal = outward(place);
  const far = ring.circle ? toCircle(place.point, normal, ring.circle) : outer;
  return [along(place.point, -inner, normal), along(place.point, far, normal)];
}

function depths({profile, inner, outer}, u) {
  const share = Math.max(0, (2 * u) / profile.length);
  return [inner, outer].map(([crown, springing]) => crown + (springing - crown) * share);
}

/** How far it is in a direction to a circle from inside it. */
function toCircle(from, direction, {centre, radius}) {
  const arm = minus(from, centre),
    b = dot(arm, direction);
  return -b + Math.sqrt(b * b - dot(arm, arm) + radius * radius);
}

function ray(ring, sigma, through, direction) {
  const end = outer => {
    if (outer && ring.circle) return along(through, toCircle(through, direction, ring.circle), direction);
    const flip = ([x, y]) => [-x, y];
    const left = () => meetsLeft(ring, -sigma, through, direction, outer);
    const right = () => {
      const found = meetsLeft(ring, sigma, flip(through), flip(direction), outer);
      return found && flip(found);
    };
    return sigma > 0 ? (right() ?? left()) : (left() ?? right());
  };
  const ends = [end(false), end(true)];
  return ends[0] && ends[1] ? ends : null;
}

/** Where a line meets a face of the left half, nearest to arc length `u`. */
function meetsLeft(ring, u, through, direction, outer) {
  const from = Math.max(0, u);
  const point = v => {
    const place = ring.profile.left(v),
      depth = depths(ring, v);
    return along(place.point, outer ? depth[1] : -depth[0], outward(place));
  };
  const miss = v => cross(direction, minus(point(v), through));
  const reach = Math.max(
    depths(ring, from).reduce((a, b) => a + b),
    1e-6 * ring.profile.length,
  );
  const root = nearestRoot(miss, from, reach / 8);
  if (root === null) return null;
  const found = point(root);
  return found[0] <= 1e-12 * ring.profile.length ? found : null;
}

function nearestRoot(f, start, step) {
  const first = f(start);
  if (first === 0) return start;
  const last = [
    [start, first],
    [start, first],
  ];
  for (let i = 1; i <= 64; i++) {
    for (const side of [0, 1]) {
      const x = start + (side ? 1 : -1) * i * step,
        here = [x, f(x)];
      if (here[1] * last[side][1] <= 0) return halve(f, last[side], here);
      last[side] = here;
    }
  }
  return null;
}

function halve(f, [a, fa], [b]) {
  for (let i = 0; i < 80; i++) {
    const x = (a + b) / 2,
      fx = f(x);
    if (fx * fa <= 0) b = x;
    else [a, fa] = [x, fx];
  }
  return (a + b) / 2;
}

/** Joints normal to the circles through neighbouring points of a surveyed intrados. */
export function surveyedJoints(points, thickness) {
  const last = points.length - 1;
  return points.map((point, k) => {
    const [back, ahead] = k === 0 ? [2, 1] : k === last ? [last - 1, last - 2] : [k - 1, k + 1];
    // Inversion about a point of a circle makes a line of it, in the direction of the tangent there.
    const inverted = j => {
      const to = minus(points[j], point);
      return to.map(t => t / dot(to, to));
    };
    const tangent = minus(inverted(ahead), inverted(back));
    return [point, along(point, thickness / Math.hypot(...tangent), [-tangent[1], tangent[0]])];
  });
}

/** Stones between the joints that follow each other, counter-clockwise from the left intrados end. */
export const stonesBetween = ends => ends.slice(1).map((ahead, k) => [ends[k][0], ahead[0], ahead[1], ends[k][1]]);
