// The explorer's face: sentence and verdict, the flying animal, the curve that is the control of the speed or
// of another number, and the gauges.

import { Curve } from "./curve.js";
import { Gauges } from "./gauges.js";
import { LinkedPush } from "./linked_push.js";
import { SPEED, withUnit } from "./numbers.js";
import { OwnData } from "./own_data.js";
import { Pins } from "./pins.js";
import { capital, make, Viewer } from "./shared.js";
import { styles } from "./styles.js";
import { Tour } from "./tour.js";
import { Verdict } from "./verdict.js";

const UNCERTIFIED = "the closest wingbeat: it does not fly";
let made = 0;

export class Face {
  // With `snap` the point rests on computed values only; without, the page can ask for any speed.
  constructor(element, { theme = "system", snap = true } = {}) {
    this.onask = () => {};
    // Set before `setChoices` by a page that can: `onpush()` brings flights of the answer on the page through gusts, by
    // `showPushes`; `onfile(file)` takes a species file or a polar.
    this.onpush = undefined;
    this.onfile = undefined;
    this.onpushed = () => {}; // a push is shown, or no longer: what `linked` names
    this.theme = theme;
    this.id = `wbx${++made}`;
    this.verdict = new Verdict();
    this.curve = new Curve((at) => this.ask({ at }), snap);
    this.gauges = new Gauges();
    this.pins = new Pins(() => this.show());
    this.tour = new Tour(this);
    this.linked = new LinkedPush(this);
    this.own = new OwnData(this);
    this.root = make("section", { class: "wbx", "aria-label": "Explorer" }, make("style", {}, styles));
    this.root.face = this;
    this.build();
    this.setTheme(theme);
    element.append(this.root);
  }

  build() {
    this.animal = this.choice("Animal", (animal) => this.ask({ animal }));
    this.along = this.choice("Slider", (along) => this.ask({ along, at: undefined }));
    this.model = this.choice("Model", (model) => this.ask({ model }));
    const choices = [this.animal, this.model, this.along].map(({ element }) => element);
    this.choices = make("div", { class: "wbx-choices" }, ...choices);
    this.state = make("p", { class: "wbx-state", role: "status" });
    this.picture = make("div", { class: "wbx-picture" });
    this.pushButton = make("button", { type: "button", class: "wbx-push", hidden: true, onclick: () => this.push() });
    this.numbers = make("tbody");
    const table = make("table", {}, this.numbers);
    const folded = make("details", { class: "wbx-more" }, make("summary", {}, "More numbers"), table);
    const judged = [make("h2", {}, "Is this flight plausible?"), this.gauges.element, this.pins.element, folded];
    const below = make("div", { class: "wbx-judged", "data-part": "gauges" }, ...judged);
    this.root.append(
      make("header", { class: "wbx-say" }, this.choices, this.verdict.sentence, this.verdict.spoken),
      // Beside the picture, or on a narrow page the verdict before it and the gauges after it.
      make("div", { class: "wbx-side" }, this.verdict.element, below),
      make("div", { class: "wbx-stage" }, this.picture, this.pushButton, this.state, this.curve.element),
      make("div", { class: "wbx-extras" }, this.tour.element, this.own.element),
      this.tour.panel,
    );
  }

  choice(label, act) {
    const id = `${this.id}-${label}`;
    const select = make("select", { id, onchange: () => act(select.value) });
    return { select, element: make("span", { class: "wbx-choice" }, make("label", { for: id }, label), select) };
  }

  // What the page hands over ----------------------------------------------------------------------------------------

  // `axes`: what the curves of the animal run along.
  setChoices({ animals, models, axes = [SPEED] }, { animal, model, along = SPEED.name }) {
    this.asked = { at: this.asked?.at, animal, model, along };
    const sliders = axes.map(({ name, label }) => ({ name, title: capital(label) }));
    const all = [[this.animal, animals, animal], [this.along, sliders, along], [this.model, models, model]];
    for (const [{ select }, options, chosen] of all) {
      select.replaceChildren(...options.map(({ name, title }) => make("option", { value: name }, title)));
      select.value = chosen;
    }
    this.along.element.hidden = axes.length < 2;
    this.tour.offer();
  }

  showCurve(data, axis = SPEED) {
    const turned = axis.name !== this.curve.axis.name;
    this.curve.show(data, axis);
    if (turned) this.own.show();
    this.tour.heardCurve();
  }

  showAnswer(answer) {
    this.answer = answer;
    const { name: along } = this.curve.axis;
    this.asked = { animal: answer.species, model: answer.model, along, at: answer[along] };
    this.animal.select.value = answer.species;
    this.model.select.value = answer.model;
    this.pins.now(answer);
    this.say("");
    this.show();
    if (this.pushing && this.isPushed(answer)) this.push();
    else this.linked.heard();
    // After the page's source has done what belongs to this answer; a provisional one is no ground for a tour's words.
    if (!answer.provisional) queueMicrotask(() => this.tour.heard());
  }

  // Flights of the answer on the page through gusts, as the viewer's scene holds them.
  showPushes(pushes) {
    const asked = document.activeElement === this.pushButton;
    this.showAnswer({ ...this.answer, scene: { ...this.answer.scene, pushes } });
    if (asked) this.viewer.pushes.element.querySelector("select")?.focus();
  }

  // Fly another flight in the picture of the answer on the page; without one, the answer's own. Beside a pinned flight
  // only answers fly.
  showBetween(flight) {
    const { answer } = this;
    if (!answer?.scene || this.pins.answer) return;
    this.fly(flight ? { ...answer.scene, flights: [flight] } : answer.scene, answer.species);
    this.label(answer, flight?.summary);
  }

  // Show an answer beside the one on the page; without one the comparison ends.
  compare(answer) {
    this.pins.pin(answer);
  }

  // Say what the reader waits for, or what went wrong; an empty text says nothing.
  say(text) {
    this.state.textContent = text;
  }

  setTheme(theme) {
    this.theme = theme;
    this.root.dataset.theme = theme;
    this.viewer?.setTheme(theme);
  }

  // Whether the page has flights of this animal and model along this axis, or can compute them; with `push`, also
  // through gusts.
  has({ animal, model, along = SPEED.name, push }) {
    const known = ({ select }, name) => [...select.options].some((option) => option.value === name);
    return [[this.animal, animal], [this.along, along], [this.model, model]].every((each) => known(...each)) && !(push && !this.onpush);
  }

  // The value on the axis at which the flight of an answer can be pushed; undefined if at none.
  pushedAt(answer) {
    return this.onpush && answer.status === "converged" ? answer[this.curve.axis.name] : undefined;
  }

  // Whether this very answer can be pushed.
  isPushed(answer) {
    const at = this.pushedAt(answer);
    return at !== undefined && at === answer[this.curve.axis.name];
  }

  // Inside ----------------------------------------------------------------------------------------------------------

  ask(change) {
    this.asked = { ...this.asked, ...change };
    this.linked.want("");
    this.onask({ ...this.asked });
  }

  // Have the flight pushed; if another one of the curve has the gusts, that one.
  push() {
    this.pushing = !this.isPushed(this.answer);
    if (this.pushing) this.ask({ at: this.pushedAt(this.answer) });
    else this.onpush();
  }

  tellPush() {
    const { answer } = this;
    const at = this.pushedAt(answer);
    this.pushButton.hidden = at === undefined || Boolean(answer.scene?.pushes);
    if (at === undefined) return;
    const where = this.isPushed(answer) ? "" : `, at ${withUnit(at, this.curve.axis.unit)}`;
    this.pushButton.textContent = `Push it with a gust${where}`;
  }

  show() {
    const { answer } = this;
    if (!answer) return;
    const pinned = this.pins.answer;
    this.root.dataset.status = answer.status;
    this.verdict.show(answer);
    this.gauges.show(answer.gauges, pinned?.gauges);
    this.curve.mark(answer[this.curve.axis.name]);
    this.curve.pin(pinned?.status === "converged" ? pinned : undefined);
    this.numbers.replaceChildren(...rows(answer, pinned));
    this.picture.hidden = !answer.scene;
    if (answer.scene) this.fly(this.pins.scene(answer), answer.species);
    this.label(answer);
    if (!answer.scene) this.say("This flight tumbles before there is anything to show.");
    this.tellPush();
  }

  // Say in the picture that it shows no flight, or one between two answers.
  label({ status }, between = "") {
    if (!this.viewer) return;
    this.viewer.warning.textContent = status === "converged" ? between : UNCERTIFIED;
    this.viewer.warning.classList.toggle("wbx-between", between !== "");
  }

  // `whose`: the species.
  fly(scene, whose) {
    const count = scene.flights.length;
    if (this.blind) return;
    const still = whose === this.whose && count === this.count && this.viewer?.ghost === this.pins.ghost;
    if (this.viewer) this.replace(scene, still);
    else {
      try {
        this.viewer = new Viewer(this.picture, scene, { theme: this.theme, compact: true });
      } catch {
        this.blind = true;
        const text = "This browser cannot draw in three dimensions: WebGL is missing or switched off.";
        this.picture.replaceChildren(make("p", {}, text));
        this.own.show();
        return;
      }
      this.own.show();
      this.viewer.pushes.onchange = () => this.onpushed();
    }
    // A beat takes about a second; of one animal the rate stays, so that one sees it beat faster or slower.
    if (whose !== this.whose) this.viewer.setBeat(1);
    [this.whose, this.count] = [whose, count];
  }

  // Show another scene; of the same animal the view stays as the reader turned it.
  replace(scene, still) {
    const { camera, controls } = this.viewer.stage;
    const [eye, target] = [camera.position.clone(), controls.target.clone()];
    this.viewer.ghost = this.pins.ghost;
    this.viewer.replace(scene);
    if (!still) return;
    camera.position.copy(eye);
    controls.target.copy(target);
    controls.update();
  }

  destroy() {
    this.own.destroy();
    this.curve.destroy();
    this.viewer?.destroy();
    this.root.remove();
  }
}

function rows(answer, pinned) {
  const before = new Map((pinned?.numbers ?? []).map(([label, value]) => [label, value]));
  const found = answer.numbers.map(([label, value, unit]) => {
    const cells = [make("td", {}, value), ...(pinned ? [make("td", {}, before.get(label) ?? "–")] : [])];
    return make("tr", {}, make("th", { scope: "row" }, label), ...cells, make("td", {}, unit));
  });
  if (!pinned) return found;
  const heads = ["", "now", "pinned", ""].map((text) => make("th", { scope: "col" }, text));
  return [make("tr", {}, ...heads), ...found];
}
