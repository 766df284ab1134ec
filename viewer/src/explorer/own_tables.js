// Two kinds of tables that a reader can show: flights measured at several speeds, and the motion of a wing over a beat.

import { named, numberIn } from "./csv.js";

const SPEED = ["speed", "airspeed", "velocity", "v", "u"];
const POWER = ["power", "p"];
// Of metabolic power, which is several times the mechanical power that the curve shows; see flights_file.py.
const METABOLIC = ["metabolic", "metab", "met", "input", "respirometry", "aerobic", "chemical"];
const FREQUENCY = ["frequency", "freq", "f", "beats"];
const ERROR = ["error", "err", "sd", "se", "sem", "std", "uncertainty"];
const LABEL = ["label", "name", "animal", "individual", "species", "source"];
const UNITS = { speed: ["m/s", "ms-1", "m s-1"], power: ["w"], frequency: ["hz", "1/s", "s-1"] };

const UNIT = { speed: "m/s", power: "W", frequency: "Hz" };

const last = (words, among) => among.includes(words.at(-1));

// What a table is; its columns as {speed, power, frequency, ...: place}, or the places of a motion's columns.
export function kindOf(header) {
  const columns = header.map((text, place) => ({ text, place, ...named(text) }));
  const isError = (column) => column.words.some((word) => ERROR.includes(word));
  const speed = columns.find((column) => last(column.words, SPEED) && !isError(column));
  if (speed) return { kind: "flights", columns: flightColumns(columns, speed, isError) };
  const clock = columns.find((column) => ["phase", "time", "t"].includes(column.words[0]) && column.words.length === 1);
  if (clock) return { kind: "motion", clock, columns: columns.filter((column) => column !== clock) };
  return { kind: undefined };
}

function flightColumns(columns, speed, isError) {
  const found = { speed };
  const isMetabolic = (column) => column.words.some((word) => METABOLIC.includes(word));
  found.metabolic = columns.find((column) => isMetabolic(column) && !isError(column));
  found.power = columns.find((column) => last(column.words, POWER) && !isMetabolic(column) && !isError(column));
  found.frequency = columns.find((column) => last(column.words, FREQUENCY) && !isError(column));
  for (const column of columns.filter((each) => isError(each) && !isMetabolic(each))) {
    const of = column.words.some((word) => FREQUENCY.includes(word))
      ? "frequency"
      : column.words.some((word) => POWER.includes(word)) || found.power
        ? "power"
        : "frequency";
    found[`${of}Error`] ??= column;
  }
  found.label = columns.find((column) => column.words.some((word) => LABEL.includes(word)));
  return found;
}

// Points {speed, power, frequency, powerError, frequencyError, label} in m/s, W and Hz.
export function flightsOf({ rows }, columns, faults) {
  for (const [name, units] of Object.entries(UNITS)) {
    for (const column of [columns[name], columns[`${name}Error`]]) {
      if (column?.unit && !units.includes(column.unit)) {
        faults.add(`Column “${column.text}” is in ${column.unit}; convert it to ${UNIT[name]}.`);
      }
    }
  }
  if (columns.metabolic && !columns.power && !columns.frequency) {
    faults.add(
      `Column “${columns.metabolic.text}” is metabolic power; the curve shows mechanical power. ` +
        "wingbeat curve --data compares both.",
    );
  } else if (!columns.power && !columns.frequency) {
    faults.add("No column is named power or frequency; at least one of them must stand beside the speed.");
  }
  const limits = { speed: { low: 0, high: 200 } };
  const points = [];
  for (const { at, cells } of rows) {
    const point = { label: cells[columns.label?.place] ?? "" };
    for (const name of ["speed", "power", "frequency", "powerError", "frequencyError"]) {
      const column = columns[name];
      if (column) point[name] = numberIn(cells[column.place], column.text, at, faults, limits[name] ?? { low: 0 });
    }
    if (point.speed === undefined) faults.add(`Line ${at} has no speed.`);
    if (point.power !== undefined || point.frequency !== undefined) points.push(point);
  }
  if (!points.length && !faults.texts.length) faults.add("No row has a speed with a power or a frequency.");
  return points;
}

// Curves {name, title, phase, values} over one beat, in SI units and in the order of the phase.
export function motionOf(table, clock, columns, faults) {
  const { rows } = table;
  if (rows.length < 3) faults.add("A wingbeat needs at least three rows.");
  const phases = phasesOf(table, clock, faults);
  const order = phases.map((_, nth) => nth).sort((one, other) => phases[one] - phases[other]);
  const sorted = order.map((nth) => phases[nth]);
  return columns.map((column) => curveOf(column, order.map((nth) => rows[nth]), sorted, faults));
}

// Times become phases by the file's frequency; without one, the rows are one beat from the first to the last.
function phasesOf({ rows, frequency }, clock, faults) {
  const isTime = clock.words[0] !== "phase";
  const known = ["", "s", "ms"].includes(clock.unit);
  if (isTime && !known) faults.add(`Column “${clock.text}” must be in s or ms.`);
  const limits = isTime ? {} : { low: 0, high: 1 };
  const clocks = rows.map(({ at, cells }) => {
    const value = numberIn(cells[clock.place], clock.text, at, faults, limits);
    if (value === undefined) faults.add(`Line ${at} has no ${isTime ? "time" : "phase"}.`);
    return value;
  });
  if (!isTime) return clocks;
  const [from, to] = [clocks[0], clocks.at(-1)];
  if (!frequency) {
    if (!(to > from)) faults.add(`Column “${clock.text}”: the last time must be later than the first.`);
    return clocks.map((value) => (value - from) / (to - from));
  }
  const beats = frequency * (clock.unit === "ms" ? 1e-3 : 1);
  return clocks.map((value) => ((((value - from) * beats) % 1) + 1) % 1);
}

// Columns of a film whose series is called otherwise.
const SERIES = { pitch: "wing_pitch", span_fraction: "span_ratio" };
// Units in which the viewer's series are.
const KNOWN = ["", "-", "1", "rad", "rad/s", "m", "m/s", "n", "w", "s", "hz"];
const ANGLES = ["flap", "pitch", "twist", "fold", "sweep", "alpha"];

function curveOf({ text, words, unit, place }, rows, phase, faults) {
  const isAngle = words.some((word) => ANGLES.includes(word)) && !words.includes("rate");
  const degrees = ["deg", "degrees", "°", "deg/s"].includes(unit);
  if (!degrees && !KNOWN.includes(unit)) {
    faults.add(`Column “${text}” is in ${unit}; convert it to SI units.`);
  } else if (isAngle && !degrees && unit !== "rad") {
    faults.add(`Column “${text}” is an angle: name its unit, as in “${words.join("_")}_deg”.`);
  }
  const scale = degrees ? Math.PI / 180 : 1;
  const values = rows.map(({ at, cells }) => {
    const value = numberIn(cells[place], text, at, faults);
    return scale * (value ?? NaN);
  });
  const name = words.join("_");
  return { name: SERIES[name] ?? name, title: text, phase, values };
}
