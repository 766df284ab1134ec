// Numbers and labels as all pages write them.

// A number with so many digits at most, without zeros at its end.
export function short(value, digits = 3) {
  return Number(value.toPrecision(digits)).toString();
}

// A number that a person would choose, at least `least`: one of these figures times a power of ten.
export function round(least, figures = [1, 2, 5, 10]) {
  const power = 10 ** Math.floor(Math.log10(least));
  return figures.map((figure) => figure * power).find((figure) => figure >= least * (1 - 1e-9));
}

// Round numbers between the ends of an axis, about `count` of them.
export function ticks(low, high, count) {
  const step = round((high - low) / count);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, nth) => Number(((first + nth) * step).toPrecision(12)));
}

export function capital(text) {
  return text.charAt(0).toUpperCase() + text.slice(1);
}
