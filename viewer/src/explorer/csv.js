// Reads tables that a reader has: cells, columns by forgiving names, and numbers. All faults of a file are reported together.

export const MOST_ROWS = 5000;
const MOST_BYTES = 2e6;
const MOST_FAULTS = 8;

// Collects what is wrong with a file.
export class Faults {
  constructor() {
    this.texts = [];
  }

  add(text) {
    if (!this.texts.includes(text)) this.texts.push(text);
  }

  // The first ones, and how many more there are.
  get told() {
    const more = this.texts.length - MOST_FAULTS;
    if (more <= 0) return this.texts;
    return [...this.texts.slice(0, MOST_FAULTS), `and ${more} more like these`];
  }
}

export function tooLarge(file) {
  if (file.size <= MOST_BYTES) return undefined;
  return `The file has ${(file.size / 1e6).toFixed(1)} MB; at most ${MOST_BYTES / 1e6} MB are read.`;
}

// Header and rows of a text; commas, semicolons or tabs stand between the cells. Lines that begin with # are comments;
// one of them may give the frequency of a wingbeat [Hz].
export function tableOf(text, faults) {
  const lines = text
    .replace(/^\uFEFF/, "")
    .split(/\r\n|\r|\n/)
    .map((line, nth) => ({ line, at: nth + 1 }))
    .filter(({ line }) => line.trim() && !line.startsWith("#"));
  if (lines.length < 2) {
    faults.add("The file has no rows: the first line names the columns, and each line below it is one row.");
    return undefined;
  }
  const separator = ["\t", ";", ","].find((each) => lines[0].line.includes(each)) ?? ",";
  const header = cells(lines[0].line, separator);
  const rows = lines.slice(1).map(({ line, at }) => ({ at, cells: cells(line, separator) }));
  if (rows.length > MOST_ROWS) faults.add(`The file has ${rows.length} rows; at most ${MOST_ROWS} are read.`);
  for (const { at, cells } of rows.slice(0, MOST_ROWS)) {
    const [here, named] = [cells.length, header.length];
    if (here !== named) faults.add(`Line ${at} has ${here} cells, the header has ${named}.`);
  }
  const given = /^#\s*frequency\s*(?:\[hz\])?\s*=\s*(.+)$/im.exec(text);
  const frequency = given ? numberIn(given[1].trim(), "frequency", 1, faults, { low: 1e-9 }) : undefined;
  return { header, rows: rows.slice(0, MOST_ROWS), frequency };
}

// Cells of a line; quotes may hold separators, and two quotes in a row are one.
function cells(line, separator) {
  const found = [""];
  let quoted = false;
  for (let i = 0; i < line.length; i++) {
    const letter = line[i];
    if (letter === '"' && quoted && line[i + 1] === '"') found[found.length - 1] += line[++i];
    else if (letter === '"') quoted = !quoted;
    else if (letter === separator && !quoted) found.push("");
    else found[found.length - 1] += letter;
  }
  return found.map((cell) => cell.trim());
}

const ANGLES = ["alpha", "alphadeg", "aoa", "aoadeg", "angleofattack", "angleofattackdeg", "α"];
const CLOCKS = ["phase", "time"];

// Whether a text is a polar: a line of its head names lift, and the angle of attack or drag. Which program wrote it, and
// what it says, is for the server to find.
export function isPolar(text) {
  return text
    .split(/\r\n|\r|\n/, 60)
    .some((line) => {
      const parts = line.toLowerCase().replace(/[[(][^\])]*[\])]/g, "").split(/[\t;,]/.test(line) ? /[\t;,]/ : /\s+/);
      const names = parts.map((part) => part.replace(/[^a-zα]/g, ""));
      const has = (...known) => known.some((name) => names.includes(name));
      return has("cl", "liftcoefficient") && has("cd", "dragcoefficient", ...ANGLES) && !has(...CLOCKS);
    });
}

// A column's words and unit: "Speed [m/s]", "speed_m_s" and "Speed (m/s)" are the same.
export function named(text) {
  const bracket = /[[(]([^\])]*)[\])]/.exec(text);
  const plain = text.replace(/[[(].*$/, "").toLowerCase().trim();
  const words = plain.split(/[\s_-]+/).filter(Boolean);
  if (bracket) return { words, unit: bracket[1].trim().toLowerCase() };
  for (const [ending, unit] of UNITS) {
    const tail = words.slice(-ending.length);
    if (words.length > ending.length && ending.every((word, nth) => word === tail[nth])) {
      return { words: words.slice(0, -ending.length), unit };
    }
  }
  return { words, unit: "" };
}

// Units as the last words of a name.
const UNITS = [
  [["m", "s"], "m/s"],
  [["m/s"], "m/s"],
  [["km", "h"], "km/h"],
  [["mps"], "m/s"],
  [["hz"], "hz"],
  [["w"], "w"],
  [["mw"], "mw"],
  [["s"], "s"],
  [["ms"], "ms"],
  [["deg"], "deg"],
  [["degrees"], "deg"],
  [["rad"], "rad"],
];

// The number in a cell; undefined where the cell is empty, and NaN where it holds no such number, which is a fault.
export function numberIn(cell, column, at, faults, { low = -Infinity, high = Infinity } = {}) {
  if (cell === undefined || /^(|na|n\/a|nan|-)$/i.test(cell)) return undefined;
  if (/^[+-]?\d+,\d+$/.test(cell)) {
    faults.add(`Line ${at}, ${column}: “${cell}” has a decimal comma; write a decimal point.`);
    return NaN;
  }
  const value = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(cell) ? Number(cell) : NaN;
  if (!Number.isFinite(value)) {
    faults.add(`Line ${at}, ${column}: “${cell.slice(0, 40)}” is no number.`);
    return NaN;
  }
  if (value < low || value > high) {
    const range = high === Infinity ? `at least ${low}` : `from ${low} to ${high}`;
    faults.add(`Line ${at}, ${column}: ${cell} must be ${range}.`);
    return NaN;
  }
  return value;
}
