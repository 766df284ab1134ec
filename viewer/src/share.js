// "Share": a link to what is shown, the page as one file, a moving picture, and a frame for other pages.

import { fileName, save } from "./copy.js";
import { make } from "./elements.js";
import { gif, videos, video } from "./recording.js";
import { stateOf } from "./state.js";

const WIDTHS = [320, 480, 640, 960];

const size = (bytes) => (bytes < 1e6 ? `${Math.round(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`);

export class Share {
  // `address(state)`: the page's address with a state; without it, there is no link to offer.
  // `script`: the element that holds the scene, where the page is one file that can be saved.
  constructor(viewer, { address, script } = {}) {
    Object.assign(this, { viewer, address, script });
    this.told = make("output", { class: "wb-note wb-told" });
    const summary = make("summary", {}, "Share");
    this.element = make(
      "details",
      { class: "wb-share", ontoggle: () => this.refresh() },
      summary,
      make("div", { class: "wb-share-parts" }, ...this.links(), this.moving(), ...this.file()),
      this.told,
    );
    // Keys that are typed here are not the viewer's.
    this.element.addEventListener("keydown", (event) => event.key !== "Escape" && event.stopPropagation());
    this.element.addEventListener("keydown", (event) => {
      if (event.key !== "Escape" || !this.element.open) return;
      this.element.open = false;
      summary.focus();
    });
  }

  tell(text) {
    this.told.textContent = text;
  }

  part(title, ...children) {
    return make("fieldset", { class: "wb-part" }, make("legend", {}, title), ...children);
  }

  button(text, act) {
    return make("button", { type: "button", onclick: act }, text);
  }

  // Link and frame --------------------------------------------------------------------------------------------------

  links() {
    if (!this.address) return [];
    this.link = make("input", { type: "text", readonly: true, "aria-label": "Link to what is shown" });
    this.frame = make("textarea", { readonly: true, rows: 3, "aria-label": "Code that shows this page in another" });
    const offline = location.protocol === "file:";
    return [
      this.part(
        "Link",
        this.link,
        this.button("Copy link", () => this.copy(this.link, "the link")),
        make(
          "p",
          { class: "wb-note" },
          offline ? "It opens this file on this computer." : "It opens this phase, camera and choice of plots.",
        ),
      ),
      this.part(
        "Frame for another page",
        this.frame,
        this.button("Copy code", () => this.copy(this.frame, "the code")),
        make(
          "p",
          { class: "wb-note" },
          offline ? "Put this file beside the other page." : "The frame loads when a reader comes near.",
        ),
      ),
    ];
  }

  // What the fields hold is what is shown when the menu opens or a copy is made.
  refresh() {
    if (!this.address || !this.element.open) return;
    this.link.value = this.address(stateOf(this.viewer));
    const here =
      location.protocol === "file:" ? this.link.value.slice(this.link.value.lastIndexOf("/") + 1) : this.link.value;
    const frame = make("iframe", {
      src: here,
      title: `Flight of ${this.label}`,
      width: 960,
      height: 640,
      loading: "lazy",
      style: "border: 0",
    });
    this.frame.value = frame.outerHTML;
  }

  get label() {
    return this.viewer.flights.map((flight) => flight.label).join(" and ");
  }

  async copy(field, what) {
    this.refresh();
    try {
      await navigator.clipboard.writeText(field.value);
      this.tell(`Copied ${what}.`);
    } catch {
      field.select();
      this.tell(`The browser does not allow to copy ${what} by itself; it is selected: press Ctrl+C or Cmd+C.`);
    }
  }

  // Moving picture --------------------------------------------------------------------------------------------------

  moving() {
    const kinds = [{ name: "GIF", ending: "gif" }, ...videos()];
    const id = `${this.viewer.id}-share`;
    const kind = make(
      "select",
      { id: `${id}-kind` },
      ...kinds.map(({ name }) => make("option", { value: name }, name)),
    );
    const width = make("select", { id: `${id}-width` });
    for (const pixels of WIDTHS)
      width.append(make("option", { value: pixels, selected: pixels === 640 }, `${pixels} px`));
    const bar = make("progress", { max: 1, value: 0, "aria-label": "Progress of the moving picture", hidden: true });
    const button = this.button("Save", () => {
      if (this.work) this.stop();
      else
        this.make(
          kinds.find(({ name }) => name === kind.value),
          Number(width.value),
          bar,
          button,
        );
    });
    const missing = kinds.length === 1 ? "This browser cannot record a canvas, so there is no video here." : "";
    const note = `One beat at the chosen speed; a video lasts at least 2\u00a0s. ${missing}`;
    return this.part(
      "Moving picture",
      make("span", { class: "wb-choice" }, make("label", { for: kind.id }, "Format"), kind),
      make("span", { class: "wb-choice" }, make("label", { for: width.id }, "Width"), width),
      button,
      bar,
      make("p", { class: "wb-note" }, note),
    );
  }

  // Make no more of a moving picture, because somebody asks for that or another flight is shown.
  stop() {
    this.work?.abort();
  }

  async make(kind, width, bar, button) {
    this.work = new AbortController();
    button.textContent = "Stop";
    bar.hidden = false;
    this.tell("");
    const progress = (share) => (bar.value = share);
    try {
      const { signal } = this.work;
      const made = kind.type
        ? await video(this.viewer, width, kind, progress, signal)
        : await gif(this.viewer, width, progress, signal);
      const name = fileName(this.label, kind.ending);
      save(made.blob, name);
      const length = made.frames ? `${made.frames} frames` : `${made.seconds.toPrecision(2)} s`;
      this.tell(`Saved ${name}: ${made.width} x ${made.height} pixels, ${length}, ${size(made.blob.size)}.`);
    } catch (error) {
      this.tell(error.name === "AbortError" ? "Stopped." : `The browser could not make it: ${error.message}`);
    } finally {
      this.work = undefined;
      button.textContent = "Save";
      bar.hidden = true;
    }
  }

  // One file --------------------------------------------------------------------------------------------------------

  file() {
    if (!this.script) return [];
    return [
      this.part(
        "One file",
        this.button("Save this page", () => this.savePage()),
        make("p", { class: "wb-note" }, "It flies offline, and opens as it is shown now."),
      ),
    ];
  }

  // The page as it was loaded, without what the viewer has added.
  savePage() {
    this.script.dataset.state = stateOf(this.viewer);
    const copy = document.documentElement.cloneNode(true);
    for (const viewer of copy.querySelectorAll(".wb-viewer")) viewer.remove();
    const text = `<!doctype html>\n${copy.outerHTML}\n`;
    const name = fileName(this.label, "html");
    save(new Blob([text], { type: "text/html" }), name);
    this.tell(`Saved ${name}, ${size(text.length)}.`);
  }
}
