// Series along a flight, in the units that readers prefer: those of the data set, per weight, or at one span fraction.

// The series that all of these flights hold.
export function offered(series, flights) {
  return series.filter(({ array }) => flights.every((flight) => array in flight.arrays));
}

// All values of a series, one a sample. They are made when first asked for, so that a page holds every array once.
export function valuesOf(flight, series) {
  flight.made ??= new Map();
  if (!flight.made.has(series.name)) flight.made.set(series.name, made(flight, series));
  return flight.made.get(series.name);
}

function made(flight, { array, scale, per, station }) {
  const values = flight.arrays[array];
  const factor = per ? scale / flight[per] : scale;
  const out = new Float64Array(flight.samples);
  const { low, high, share } = between(values.length / flight.samples, station ?? 0);
  const width = values.length / flight.samples;
  for (let k = 0; k < flight.samples; k++) {
    const [inner, outer] = [values[k * width + low], values[k * width + high]];
    out[k] = factor * (inner + share * (outer - inner));
  }
  return out;
}

// The strips beside a span fraction; their values are those of their centres.
function between(strips, station) {
  const place = Math.min(Math.max(station * strips - 0.5, 0), strips - 1);
  const low = Math.min(Math.floor(place), Math.max(strips - 2, 0));
  return { low, high: Math.min(low + 1, strips - 1), share: place - low };
}

export function valueAt(flight, series, place) {
  const values = valuesOf(flight, series);
  return values[place.low] + place.share * (values[place.high] - values[place.low]);
}

// Least and largest of some values between two samples, with a margin, as the ends of an axis.
export function ends(lists, from = 0, to = Infinity) {
  let [low, high] = [Infinity, -Infinity];
  for (const values of lists) {
    for (let k = from; k <= Math.min(to, values.length - 1); k++) {
      if (!Number.isFinite(values[k])) continue;
      [low, high] = [Math.min(low, values[k]), Math.max(high, values[k])];
    }
  }
  if (low > high) return [-1, 1];
  if (low > 0 && low < 0.4 * high) low = 0;
  const size = Math.max(Math.abs(low), Math.abs(high));
  // A curve that is flat but for rounding is shown flat.
  const margin = high - low > 1e-6 * size ? 0.06 * (high - low) : 0.06 * size || 1;
  return [low - margin, high + margin];
}

// Series by their units, for a menu and because only curves of one unit share an axis.
export function byUnit(series) {
  const groups = new Map();
  for (const one of series) {
    if (!groups.has(one.unit)) groups.set(one.unit, []);
    groups.get(one.unit).push(one);
  }
  return groups;
}

export function inUnit(unit) {
  return unit ? `[${unit}]` : "[-]";
}
