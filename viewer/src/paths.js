// Paths of wing tips and body through the flight and the beats before it, in the world of the data.

// Samples of a flight in order, with `before` repeats in front if it is periodic: sample, and by how much its phase,
// x and z are shifted.
export function samples(flight, before) {
  const { x, z } = flight.arrays;
  const end = flight.samples - 1;
  const repeats = flight.periodic ? before : 0;
  const found = [];
  for (let beat = -repeats; beat <= 0; beat++) {
    const shift = { phase: beat * flight.last, x: beat * (x[end] - x[0]), z: beat * (z[end] - z[0]) };
    // The last sample of a beat is the first of the next.
    for (let k = beat === -repeats ? 0 : 1; k <= end; k++) found.push({ k, shift });
  }
  return found;
}

// The body's centre of mass at a sample [m].
export function body(flight, { k, shift }) {
  return [flight.arrays.x[k] + shift.x, 0, flight.arrays.z[k] + shift.z];
}

// The quarter chord at a tip at a sample [m]: from leading-outer to trailing-outer of the last strip.
export function tip(flight, sample, side) {
  const at = 12 * (flight.strips * sample.k + flight.strips - 1);
  const { corners } = flight.arrays;
  const mass = body(flight, sample);
  return [1, side, 1].map((sign, i) => {
    const lead = corners[at + 3 + i];
    return mass[i] + sign * (lead + 0.25 * (corners[at + 6 + i] - lead));
  });
}

// The trailing edge from the left tip to the right tip at a sample, flat [m].
export function trailingEdge(flight, sample) {
  const { corners } = flight.arrays;
  const mass = body(flight, sample);
  const place = (strip, corner, side) => {
    const at = 12 * (flight.strips * sample.k + strip) + 3 * corner;
    return [1, side, 1].map((sign, i) => mass[i] + sign * corners[at + i]);
  };
  const half = (side) => [
    ...place(0, 3, side),
    ...Array.from({ length: flight.strips }, (_, strip) => place(strip, 2, side)).flat(),
  ];
  const [left, right] = [half(1), half(-1)];
  const points = [];
  for (let i = left.length - 3; i >= 0; i -= 3) points.push(...left.slice(i, i + 3));
  return [...points, ...right];
}

// How many strips at the tip count as the outer ones: a fifth of them, at least one.
export function outerStrips(flight) {
  return Math.max(1, Math.round(flight.strips / 5));
}

// The force on the outer strips of one wing at every sample [N].
export function outerForce(flight) {
  const { force } = flight.arrays;
  return Array.from({ length: flight.samples }, (_, k) => {
    const sum = [0, 0, 0];
    for (let strip = flight.strips - outerStrips(flight); strip < flight.strips; strip++) {
      for (let i = 0; i < 3; i++) sum[i] += force[3 * (flight.strips * k + strip) + i];
    }
    return Math.hypot(...sum);
  });
}
