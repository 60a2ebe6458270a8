// Profile lines: the curve from which an arch is set out, as a place for every arc length from the crown (negative on the left).
// The page draws what is typed with this; every number of an answer comes from the service.

/** {length, hasApex, at(sigma)}; a place is {point, tangent}, and `left(u)` goes on beyond the ends of the left half. */
function profile(half, left, hasApex = false) {
  const at = sigma => (sigma > 0 ? mirrored(left(sigma)) : left(-sigma));
  return {length: 2 * half, hasApex, left, at};
}

const mirrored = ({point: [x, y], tangent: [a, b]}) => ({point: [-x, y], tangent: [a, -b]});

/** Tangent circular arcs [radius, angle] from the crown down to the left springing; the first normal leans by so much. */
function arcs(leanAtCrown, fromCrown) {
  let lean = leanAtCrown,
    start = 0,
    point = [0, 0];
  const parts = [];
  for (const [radius, angle] of fromCrown) {
    const centre = [point[0] + radius * Math.sin(lean), point[1] - radius * Math.cos(lean)];
    parts.push({centre, radius, start, lean});
    lean += angle;
    start += radius * angle;
    point = [centre[0] - radius * Math.sin(lean), centre[1] + radius * Math.cos(lean)];
  }
  const down = point[1];
  const left = u => {
    const part = parts.findLast(({start}) => start <= u) ?? parts[0];
    const turn = part.lean + (u - part.start) / part.radius;
    const [sin, cos] = [Math.sin(turn), Math.cos(turn)];
    return {
      point: [part.centre[0] - part.radius * sin, part.centre[1] - down + part.radius * cos],
      tangent: [cos, sin],
    };
  };
  return profile(start, left, leanAtCrown > 1e-12);
}

const PANELS = 1024;

/** Half an ellipse; its arc length is summed over panels and turned round by interpolation and Newton's method. */
function ellipse(a, b) {
  const speed = phi => Math.hypot(a * Math.cos(phi), b * Math.sin(phi));
  const between = (from, to) => ((to - from) / 6) * (speed(from) + 4 * speed((from + to) / 2) + speed(to));
  const start = k => ((Math.PI / 2) * k) / PANELS;
  const lengths = [0];
  for (let k = 0; k < PANELS; k++) lengths.push(lengths[k] + between(start(k), start(k + 1)));
  const quarter = lengths[PANELS];
  const parameter = u => {
    const k = Math.min(PANELS - 1, Math.max(0, lengths.findIndex(length => length > u) - 1));
    const panel = u >= quarter ? PANELS - 1 : k;
    let phi = start(panel);
    for (let i = 0; i < 6; i++) phi -= (lengths[panel] + between(start(panel), phi) - u) / speed(phi);
    return phi;
  };
  const left = u => {
    const phi = u < 0 ? -parameter(-u) : u > quarter ? Math.PI - parameter(2 * quarter - u) : parameter(u);
    const tangent = [a * Math.cos(phi), b * Math.sin(phi)];
    const size = Math.hypot(...tangent);
    return {point: [-a * Math.sin(phi), b * Math.cos(phi)], tangent: tangent.map(t => t / size)};
  };
  return profile(quarter, left);
}

const rad = degrees => (degrees * Math.PI) / 180;

/** The profile line of a request; null where it is not complete. */
export function profileOf({circular, pointed, elliptical, multi_centre: oval} = {}) {
  if (circular?.span_m > 0 && circular.rise_m > 0) {
    const half = circular.span_m / 2;
    return arcs(0, [
      [(half ** 2 + circular.rise_m ** 2) / (2 * circular.rise_m), 2 * Math.atan(circular.rise_m / half)],
    ]);
  }
  if (circular?.radius_m > 0 && circular.opening_angle_deg > 0)
    return arcs(0, [[circular.radius_m, rad(circular.opening_angle_deg) / 2]]);
  if (pointed?.span_m > 0 && pointed.rise_m >= pointed.span_m / 2) {
    const half = pointed.span_m / 2,
      sum = pointed.rise_m ** 2 / half;
    return twoArcs((sum + half) / 2, (sum - half) / 2);
  }
  if (pointed?.radius_m > 0 && pointed.centre_offset_m >= 0) return twoArcs(pointed.radius_m, pointed.centre_offset_m);
  if (elliptical?.span_m > 0 && elliptical.rise_m > 0) return ellipse(elliptical.span_m / 2, elliptical.rise_m);
  if (oval?.arcs?.length > 0 && oval.arcs.every(arc => arc.radius_m > 0 && arc.angle_deg > 0)) {
    return arcs(0, oval.arcs.map(arc => [arc.radius_m, rad(arc.angle_deg)]).reverse());
  }
  return null;
}

function twoArcs(radius, offset) {
  const lean = Math.asin(offset / radius);
  return arcs(lean, [[radius, Math.PI / 2 - lean]]);
}
