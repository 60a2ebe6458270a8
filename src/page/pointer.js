// Values of a request by their JSON Pointers (RFC 6901), such as /arch/thickness/constant_m.

const keys = at =>
  at
    .split('/')
    .slice(1)
    .map(key => key.replaceAll('~1', '/').replaceAll('~0', '~'));

export function look(request, at) {
  return keys(at).reduce((value, key) => value?.[key], request);
}

/** Sets a value; objects on the way to it are made. Undefined removes it. */
export function set(request, at, value) {
  const path = keys(at),
    last = path.pop();
  let place = request;
  for (const key of path) place = place[key] ??= {};
  if (value !== undefined) place[last] = value;
  else if (Array.isArray(place)) place.splice(Number(last), 1);
  else delete place[last];
}

/** The longest of these pointers that is `at` or leads to it. */
export function nearest(pointers, at) {
  return pointers.filter(one => at === one || at.startsWith(`${one}/`)).sort((a, b) => b.length - a.length)[0];
}

/** A request as text: short lists of numbers on one line. */
export function written(request) {
  return JSON.stringify(request, null, 2).replace(
    /\[\s+([-\d.eE+]+(?:,\s+[-\d.eE+]+)*)\s+\]/g,
    (_, list) => `[${list.replace(/\s+/g, ' ')}]`,
  );
}
