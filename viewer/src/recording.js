// Moving pictures for elsewhere, made in the browser: one beat as a GIF, or as a video where the browser records them.
/*! GIFs are written by gifenc 1.0.3, copyright 2017 Matt DesLauriers, MIT license */

import { applyPalette, GIFEncoder, quantize } from "gifenc";
import { Film } from "./frames.js";

const [MOST_FRAMES, FEWEST_FRAMES] = [48, 12];
const SHORTEST_FRAME = 20; // ms; viewers of GIFs show shorter ones slowly
const SHORTEST_VIDEO = 2; // s
const VIDEOS = [
  { type: "video/mp4;codecs=avc1.42E01F", ending: "mp4", name: "MP4" },
  { type: "video/webm;codecs=vp9", ending: "webm", name: "WebM" },
  { type: "video/webm", ending: "webm", name: "WebM" },
];

// The kinds of video that this browser records; none without MediaRecorder.
export function videos() {
  const able = VIDEOS.filter(
    ({ type }) => window.MediaRecorder?.isTypeSupported(type) && HTMLCanvasElement.prototype.captureStream,
  );
  return able.filter(({ ending }, nth) => able.findIndex((other) => other.ending === ending) === nth);
}

// First and last phase of the beat that is shown now, and how long the viewer takes for it [s].
function beat({ phase, last, rate, flights }) {
  const from = Math.max(Math.min(Math.floor(phase), last - 1), 0);
  const to = Math.min(from + 1, last);
  return { from, to, seconds: (to - from) / (flights[0].frequency * rate) };
}

const pause = () => new Promise((done) => setTimeout(done));

// `progress(share)` is called after every frame; `signal`: of an AbortController. Returns a Blob, its frames and size.
export async function gif(viewer, width, progress, signal) {
  const { from, to, seconds } = beat(viewer);
  const frames = Math.max(Math.min(MOST_FRAMES, Math.floor((1000 * seconds) / SHORTEST_FRAME)), FEWEST_FRAMES);
  const delay = Math.max(Math.round((1000 * seconds) / frames), SHORTEST_FRAME);
  const film = new Film(viewer, width);
  const { canvas, pen } = film;
  const pixels = (nth) => {
    film.paint(from + ((to - from) * nth) / frames);
    return pen.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  try {
    // One palette for all frames, from four of them: with a new one each, still colours would flicker.
    const sample = [0, 1, 2, 3].flatMap((quarter) => thinned(pixels((quarter * frames) / 4)));
    const palette = quantize(new Uint8Array(sample), 256);
    const encoder = GIFEncoder();
    for (let nth = 0; nth < frames; nth++) {
      signal.throwIfAborted();
      const look = nth ? {} : { palette, repeat: 0 };
      encoder.writeFrame(applyPalette(pixels(nth), palette), canvas.width, canvas.height, { delay, ...look });
      progress((nth + 1) / frames);
      await pause();
    }
    encoder.finish();
    return { blob: new Blob([encoder.bytes()], { type: "image/gif" }), frames, width, height: canvas.height };
  } finally {
    film.end();
  }
}

// Every 13th pixel is enough for a palette.
function thinned(data) {
  const found = [];
  for (let at = 0; at < data.length; at += 4 * 13) found.push(data[at], data[at + 1], data[at + 2], 255);
  return found;
}

// Recorded while it plays, at the viewer's speed; whole beats for at least two seconds.
export async function video(viewer, width, { type }, progress, signal) {
  const { from, to, seconds } = beat(viewer);
  const whole = seconds * Math.ceil(SHORTEST_VIDEO / seconds);
  const film = new Film(viewer, width);
  try {
    film.paint(from);
    const recorder = new MediaRecorder(film.canvas.captureStream(), { mimeType: type, videoBitsPerSecond: 8e6 });
    const parts = [];
    recorder.addEventListener("dataavailable", (event) => parts.push(event.data));
    const stopped = new Promise((done, fail) => {
      recorder.addEventListener("stop", done);
      recorder.addEventListener("error", (event) => fail(event.error));
    });
    recorder.start();
    const start = performance.now();
    for (let spent = 0; spent < whole && !signal.aborted; spent = 0.001 * (performance.now() - start)) {
      film.paint(from + ((spent / seconds) % 1) * (to - from));
      progress(spent / whole);
      await new Promise((done) => requestAnimationFrame(done));
    }
    recorder.stop();
    await stopped;
    signal.throwIfAborted();
    return { blob: new Blob(parts, { type: type.split(";")[0] }), seconds: whole, width, height: film.canvas.height };
  } finally {
    film.end();
  }
}
