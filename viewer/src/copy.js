// Copies of a plot: its numbers as a table, its drawing as a picture. To the clipboard, else as a download.

import { draw } from "./elements.js";
import { PHASE } from "./card.js";
import { inUnit, valuesOf } from "./series.js";

const LOOK = [
  "fill",
  "stroke",
  "stroke-width",
  "stroke-dasharray",
  "stroke-linecap",
  "stroke-linejoin",
  "opacity",
  "font-size",
  "font-weight",
  "visibility",
];
const ENLARGED = 4;

export function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

// A name that every file system takes.
export function fileName(text, ending) {
  return `${
    text
      .toLowerCase()
      .replace(/[^\p{L}\p{N}]+/gu, "-")
      .replace(/^-|-$/g, "")
      .slice(0, 60) || "flight"
  }.${ending}`;
}

// `blob`: a promise, as the browser wants it while the click still counts. Returns whether the clipboard has it.
async function toClipboard(blob, type) {
  try {
    await navigator.clipboard.write([new ClipboardItem({ [type]: blob })]);
    return true;
  } catch {
    return false; // not allowed here, or the browser cannot do it
  }
}

async function hand(plots, blob, type, name, what) {
  const copied = await toClipboard(blob, type);
  if (!copied) save(await blob, name);
  plots.tell(copied ? `Copied ${what}.` : `Saved ${what} as ${name}; the browser does not allow to copy it.`);
}

// Numbers -----------------------------------------------------------------------------------------------------------

function cell(value) {
  if (typeof value === "number") return Number.isFinite(value) ? String(Number(value.toPrecision(9))) : "";
  return /[",\n\r]/.test(value) ? `"${value.replaceAll('"', '""')}"` : value;
}

// Phase, time and the given series, one line a sample; with two flights the first column says which.
export function table(flights, series) {
  const heads = ["phase [-]", "time [s]", ...series.map(({ label, unit }) => `${label} ${inUnit(unit)}`)];
  const lines = [flights.length > 1 ? ["flight", ...heads] : heads];
  for (const flight of flights) {
    const columns = [flight.phase, flight.arrays.time, ...series.map((one) => valuesOf(flight, one))];
    for (let k = 0; k < flight.samples; k++) {
      const numbers = columns.map((column) => column[k]);
      lines.push(flights.length > 1 ? [flight.label, ...numbers] : numbers);
    }
  }
  return lines.map((line) => `${line.map(cell).join(",")}\n`).join("");
}

export function seriesOf({ choice, plots }) {
  return [...(choice.x === PHASE ? [] : [choice.x]), ...choice.ys].map(plots.named);
}

export async function copyTable(card) {
  const { plots } = card;
  const text = table(plots.flights, seriesOf(card));
  const name = fileName(`${plots.flights[0].label} ${card.choice.ys.join(" ")}`, "csv");
  const blob = new Blob([text], { type: "text/plain" });
  await hand(plots, Promise.resolve(blob), "text/plain", name, `${text.split("\n").length - 2} rows as CSV`);
}

// Picture -----------------------------------------------------------------------------------------------------------

// What style sheets say of a drawing, written into a copy of it, which then needs none.
function styled(svg) {
  const copy = svg.cloneNode(true);
  const [from, to] = [svg, copy].map((root) => [...root.querySelectorAll("*")]);
  from.forEach((node, nth) => {
    const style = getComputedStyle(node);
    for (const name of LOOK) to[nth].setAttribute(name, style.getPropertyValue(name));
  });
  return copy;
}

// The drawing with the labels that the page has around it, as a picture in a data address.
function complete(card) {
  const { axes, choice, plots } = card;
  const [, , width, height] = axes.svg.getAttribute("viewBox").split(" ").map(Number);
  const { color, backgroundColor } = getComputedStyle(card.element.closest(".wb-viewer"));
  const rows = choice.ys.map((name, nth) => ({
    text: plots.named(name).label,
    curve: axes.curves.querySelector(`.wb-curve-${nth}`),
  }));
  const top = 14 * rows.length + 4;
  const across = choice.x === PHASE ? "phase of the beat" : `against ${plots.named(choice.x).label}`;
  const feet = [
    across,
    ...(plots.flights.length > 1 ? [`solid: ${plots.flights[0].label}; dashed: ${plots.flights[1].label}`] : []),
  ];
  const label = (text, y, fill) => draw("text", { x: 46, y, fill, "font-size": 11 }, text);
  const whole = [width, top + height + 14 * feet.length + 4];
  const inner = styled(axes.svg);
  for (const mark of inner.querySelectorAll(".wb-cursor, .wb-dot")) mark.remove(); // of one instant, which the copy does not name
  for (const [name, value] of Object.entries({ y: top, width, height })) inner.setAttribute(name, value);
  const outer = draw(
    "svg",
    {
      xmlns: "http://www.w3.org/2000/svg",
      viewBox: `0 0 ${whole.join(" ")}`,
      width: ENLARGED * whole[0],
      height: ENLARGED * whole[1],
    },
    draw("rect", { width: whole[0], height: whole[1], fill: backgroundColor }),
    ...rows.map(({ text, curve }, nth) => label(text, 14 * (nth + 1), getComputedStyle(curve).stroke)),
    inner,
    ...feet.map((text, nth) => label(text, top + height + 14 * (nth + 1) - 2, color)),
  );
  outer.setAttribute("font-family", "system-ui, sans-serif");
  return {
    address: `data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(outer))}`,
    whole,
  };
}

export async function picture(card) {
  const { address, whole } = complete(card);
  const image = new Image();
  image.src = address;
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = whole.map((size) => ENLARGED * size);
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  return new Promise((done) => canvas.toBlob(done, "image/png"));
}

export async function copyPicture(card) {
  const { plots, choice } = card;
  const name = fileName(`${plots.flights[0].label} ${choice.ys.join(" ")}`, "png");
  await hand(plots, picture(card), "image/png", name, "the plot as a picture");
}
