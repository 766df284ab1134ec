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

// The quarter chord at a span fraction from 0 to 1 at a sample [m].
export function quarterChord(flight, sample, fraction, side) {
  const along = fraction * flight.strips;
  const strip = Math.min(Math.floor(along), flight.strips - 1);
  const at = 12 * (flight.strips * sample.k + strip);
  const { corners } = flight.arrays;
  const mass = body(flight, sample);
  return [1, side, 1].map((sign, i) => {
    const [inner, outer] = [0, 3].map((lead) => {
      const trail = 9 - lead; // corners: leading inner and outer, trailing outer and inner
      return 0.75 * corners[at + lead + i] + 0.25 * corners[at + trail + i];
    });
    return mass[i] + sign * (inner + (along - strip) * (outer - inner));
  });
}

// The quarter chord at a tip at a sample [m].
export function tip(flight, sample, side) {
  return quarterChord(flight, sample, 1, side);
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
