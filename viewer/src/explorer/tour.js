// Runs a guided tour: asks for the flight of a step, sets the view, and says what the reader sees.

import { SPEED } from "./numbers.js";
import { make, setView, viewOf } from "./shared.js";
import { PLACES, STORIES } from "./stories.js";
import { emphasised } from "./words.js";

const MOST_TRIES = 6; // of asking for the flight of one step; a page that shows another one every time has it not

export class Tour {
  // `face`: the explorer that the tour moves.
  constructor(face) {
    this.face = face;
    this.calm = window.matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.cards = STORIES.map((story) => this.card(story));
    const list = make("ul", {}, ...this.cards.map(({ element }) => element));
    this.element = make("section", { class: "wbx-tours" }, make("h2", {}, "Guided tours"), list);
    this.build();
  }

  card(story) {
    const button = make("button", { type: "button", onclick: () => this.start(story, button) }, story.title);
    const words = make("span");
    return { story, button, words, element: make("li", {}, button, words) };
  }

  // Offer the tours of which the page has at least one flight.
  offer() {
    for (const { story, button, words } of this.cards) {
      button.disabled = !story.steps.some((step) => this.flight(step));
      words.textContent = button.disabled ? "This page has no flight of this tour." : story.teaser;
    }
  }

  build() {
    const button = (text, act, more = {}) => make("button", { type: "button", onclick: act, ...more }, text);
    this.count = make("p", { class: "wbx-hint" });
    this.title = make("h2", { tabindex: "-1" });
    this.text = make("div", { class: "wbx-tour-text", "aria-live": "polite" });
    this.back = button("Back", () => this.go(this.nth - 1, -1));
    this.again = button("Show this step again", () => this.go(this.nth, 1), { hidden: true });
    this.next = button("Next", () => (this.isLast ? this.close() : this.go(this.nth + 1, 1)), { "data-go": "next" });
    const close = button("×", () => this.close(), { class: "wbx-close", "aria-label": "Close the tour" });
    this.panel = make(
      "section",
      { class: "wbx-tour", "aria-label": "Guided tour", hidden: true, onkeydown: (event) => this.key(event) },
      make("div", { class: "wbx-row" }, this.count, close),
      this.title,
      this.text,
      make("div", { class: "wbx-row" }, this.back, this.again, this.next),
    );
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const act = { ArrowRight: this.next, ArrowLeft: this.back }[event.key];
    if (event.key === "Escape") this.close();
    else if (act && !act.disabled) act.click();
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  // Steps -----------------------------------------------------------------------------------------------------------

  start(story, opener) {
    this.before ??= this.found();
    Object.assign(this, { story, opener, seen: {} });
    this.panel.hidden = false;
    this.face.root.dataset.tour = story.name;
    this.title.focus({ preventScroll: true });
    this.go(0, 1);
  }

  // What the reader had chosen before the tour.
  found() {
    const { viewer, pins } = this.face;
    return { view: viewer && viewOf(viewer), pinned: pins.answer, ghost: pins.ghost };
  }

  // The flight of the last step stays; all else is as before the tour.
  close() {
    const { viewer, pins } = this.face;
    this.pin(undefined);
    if (pins.ghost !== this.before.ghost) pins.turn();
    if (viewer && this.before.view) setView(viewer, this.before.view);
    this.before = undefined;
    this.panel.hidden = true;
    this.step = undefined;
    delete this.face.root.dataset.tour;
    delete this.face.root.dataset.look;
    this.opener.focus();
  }

  // The flight of a step, with the first of its models that the page has; nothing if it has none.
  flight({ flight }) {
    const push = flight.at === "pushed";
    const asked = { animal: flight.animal, along: flight.along ?? SPEED.name };
    const model = [flight.model].flat().find((each) => this.face.has({ ...asked, model: each, push }));
    return model && { ...asked, model };
  }

  // Show a step, or the next one in this direction whose flight the page has.
  go(nth, way) {
    const { steps } = this.story;
    const left = [];
    let at = nth;
    for (; steps[at] && !this.flight(steps[at]); at += way) left.push(steps[at].title);
    const rest = steps.slice(at + 1);
    const isLast = !rest.some((step) => this.flight(step));
    if (isLast) left.push(...rest.map(({ title }) => title));
    this.left = left.map((title) => `Left out, because this page has no such flight: “${title}”.`);
    Object.assign(this, { nth: at, step: steps[at], ready: false, tries: 0, isLast });
    this.count.textContent = `${this.story.title}: ${at + 1} of ${steps.length}`;
    this.title.textContent = this.step.title;
    this.back.disabled = !steps.slice(0, at).some((step) => this.flight(step));
    this.next.textContent = this.isLast ? "Finish" : "Next";
    this.again.hidden = true;
    this.say(["Looking for this flight …"]);
    this.ask();
  }

  // The page shows an answer or more of a curve: does the step go on, or has the reader left its flight?
  heard() {
    if (!this.step) return;
    if (this.ready) this.again.hidden = same(this.face.answer, this.shown);
    else this.ask();
  }

  heardCurve() {
    if (this.step && this.waitsForCurve && !this.face.answer.provisional) this.ask();
  }

  // Ask for animal, axis and model, then, when their curve is known, for the place on it, then for flights through gusts.
  ask() {
    const { face, step } = this;
    const { animal, along, model } = this.flight(step);
    const { answer } = face;
    const isThere = answer?.species === animal && answer.model === model && face.curve.axis.name === along;
    if (!isThere) return this.request({ animal, along, model });
    const { pending = [], points } = face.curve.data;
    this.waitsForCurve = pending.length > 0;
    if (this.waitsForCurve) return this.say([`Computing the curve; ${pending.length} more flights to go.`]);
    const at = this.place(points.filter((point) => point.certified));
    if (at !== undefined && Math.abs(at - answer[along]) > 1e-9) return this.request({ at });
    if (step.push && !answer.scene?.pushes && answer.status === "converged") {
      this.say(["Flying through the gusts …"]);
      return face.onpush();
    }
    this.arrive(answer);
  }

  request(change) {
    this.tries += 1;
    if (this.tries > MOST_TRIES) this.finish(["This page does not have the flight of this step."]);
    else this.face.ask(change);
  }

  // The value on the axis that the step asks for.
  place(points) {
    const { step, seen, face } = this;
    const { name } = face.curve.axis;
    if (step.flight.at === "pushed") return face.pushedAt(face.answer);
    if (seen[step.placeOf]) return seen[step.placeOf][name];
    return points.length ? PLACES[step.flight.at](points, name)[name] : undefined;
  }

  arrive(answer) {
    const { step, seen } = this;
    this.ready = true;
    if (answer.status === "converged") seen[step.name] = answer;
    this.pin(seen[step.pin]);
    this.look();
    if (!step.push) this.face.viewer?.pushes.reset();
    if (answer.status !== "converged") return this.finish([answer.sentence]);
    const push = step.push && this.push(answer.scene.pushes);
    if (step.push && !push) return this.finish(["No feedback was found that holds this flight."]);
    const { points } = this.face.curve.data;
    this.finish(step.tell({ now: answer, seen, points, push, semiSpan: answer.scene.flights[0].semi_span }));
  }

  finish(sentences) {
    this.ready = true;
    this.shown = this.face.answer;
    this.say(sentences);
  }

  say(sentences) {
    const notes = this.left.map((text) => make("p", { class: "wbx-hint" }, text));
    this.text.replaceChildren(...notes, ...sentences.map((text) => make("p", {}, ...emphasised(text))));
  }

  // View ------------------------------------------------------------------------------------------------------------

  // Compare with the answer of an earlier step; else with what the reader pinned.
  pin(answer) {
    const { pins } = this.face;
    const isOurs = this.pinned && pins.answer === this.pinned;
    const wanted = answer ?? (isOurs ? this.before.pinned : pins.answer);
    if (wanted !== pins.answer) pins.pin(wanted);
    this.pinned = answer;
  }

  // Show the flight of a push, which begins at once unless the reader asked for less motion.
  push(pushes) {
    const { direction, feedback } = this.step.push;
    const found = pushes.find((each) => each.direction === direction && each.feedback === feedback);
    if (found) this.face.viewer.pushes.choose(found);
    return found;
  }

  look() {
    const { viewer, root } = this.face;
    if (!viewer) return;
    const { camera, arrows } = this.step.view;
    const shown = { resultant: arrows, lift: false, drag: false, trails: true };
    viewer.setCamera(camera);
    for (const label of viewer.root.querySelectorAll(".wb-toggle")) {
      const box = label.querySelector("input");
      const wanted = shown[label.textContent.trim()];
      if (wanted !== undefined && box.checked !== wanted) box.click();
    }
    root.dataset.look = this.step.look;
    const part = this.step.look === "picture" ? viewer.picture : root.querySelector(`[data-part="${this.step.look}"]`);
    this.scroll(root, part);
  }

  // Show the page from its top, if that shows the part to look at as well; else that part. On a narrow page the tour
  // covers the lower part.
  scroll(root, part) {
    const behavior = this.calm ? "auto" : "smooth";
    const covered = this.panel.offsetWidth < window.innerWidth ? 0 : this.panel.offsetHeight;
    const needed = part.getBoundingClientRect().bottom - root.getBoundingClientRect().top;
    if (needed <= window.innerHeight - covered) root.scrollIntoView({ block: "start", behavior });
    else part.scrollIntoView({ block: "end", behavior });
  }
}

function same(one, other) {
  return ["species", "model", "speed", one.axis?.name].every((name) => one[name] === other[name]);
}
