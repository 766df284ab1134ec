// What the explorer's page does in the browser itself: the face, uploads, downloads, the link, and refused choices.
const json = async (url) => {
  const answer = await fetch(url);
  return answer.ok ? answer.json() : null;
};

const PATIENCE = 2000; // ms for the answer to the speed where the point was let go

window.wingbeatPage = {
  face: undefined,
  theme: "system",
  asked: 0,
  shown: 0,
  compared: 0,

  // Build the face as soon as its place is on the page. What was solved beforehand is fetched meanwhile.
  begin({ choices, chosen, ready, session }) {
    const first = ready ? json(ready) : null;
    this.built = new Promise((built) => {
      const build = () => {
        const place = document.getElementById("answer");
        if (!place || !window.wingbeatExplorer) return;
        watcher.disconnect();
        this.face = wingbeatExplorer.explore(place, { theme: this.theme, snap: false });
        this.face.onask = ({ animal, model, at: speed }) => {
          const asked = { animal, model, speed };
          this.want(asked);
          place.dispatchEvent(new CustomEvent("ask", { detail: asked }));
        };
        this.face.onpushed = () => this.linkPush();
        this.face.linked.want(pushInAddress());
        this.face.onpush = () => place.dispatchEvent(new CustomEvent("push"));
        this.face.pins.onpin = (wanted) => place.dispatchEvent(new CustomEvent("pin", { detail: wanted }));
        this.face.onfile = async (file) => {
          const refused = await this.upload({ files: [file] }, session);
          if (refused) this.face.own.refuse(file.name, [refused]);
        };
        this.face.setChoices(choices, chosen);
        if (!ready) this.face.say("Solving the first wingbeat. The first solve after the server starts takes some seconds.");
        watchRefusals();
        watchHead();
        built();
      };
      const watcher = new MutationObserver(build);
      watcher.observe(document, { childList: true, subtree: true });
    });
    if (first) this.showFirst(first);
  },

  async showFirst(first) {
    const found = await first;
    await this.built;
    if (!found || this.asked) return;
    this.face.showCurve(found.curve);
    this.face.showAnswer(found.answer);
  },

  // Each answer has its own request; one that arrives after a later one is not shown. A `provisional` one was continued,
  // and a search from every start follows.
  show(url, provisional) {
    this.showing = this.fetchAndShow(url, provisional);
  },

  async fetchAndShow(url, provisional) {
    const mine = ++this.asked;
    const answer = await json(url);
    await this.built;
    if (!answer || mine < this.shown) return;
    this.shown = mine;
    this.face.showAnswer({ ...answer, provisional });
    // The point stays where it was let go, while answers to speeds on its way come in.
    const { wanted } = this;
    if (wanted && wanted.speed !== answer.speed && performance.now() < wanted.until) this.face.curve.mark(wanted.speed);
  },

  // Remember the speed of the same animal that was asked for last.
  want({ animal, model, speed }) {
    const { answer } = this.face;
    const isSame = answer?.species === animal && answer.model === model;
    this.wanted = isSame ? { speed, until: performance.now() + PATIENCE } : undefined;
  },

  async showCurve(data) {
    await this.built;
    this.face.showCurve(data);
  },

  async choose(choices, chosen) {
    await this.built;
    this.face.setChoices(choices, chosen);
  },

  async compare(url) {
    const mine = ++this.compared;
    const answer = url && (await json(url));
    await this.built;
    if (mine === this.compared) this.face.compare(answer ?? undefined);
  },

  // Add flights through gusts to the answer on the page.
  async push(url, words) {
    const mine = this.asked;
    const pushes = await json(url);
    await this.showing;
    if (!pushes || mine !== this.asked) return;
    this.face.showPushes(pushes);
    this.face.say(words);
    document.querySelector(".wb-push").scrollIntoView({ block: "nearest" });
  },

  async say(text) {
    await this.built;
    this.face.say(text);
  },

  setTheme(theme) {
    this.theme = theme;
    this.face?.setTheme(theme);
  },

  // Send a file; return why it was refused, nothing if it was taken.
  async upload(input, session) {
    const file = input.files[0];
    if (!file) return "";
    input.value = "";
    const refused = `${file.name.slice(-60)} was refused: a file may have at most 5 million bytes.`;
    if (file.size > 5_000_000) return refused;
    try {
      const address = `/wingbeat/upload/${session}?name=${encodeURIComponent(file.name)}`;
      const answer = await fetch(address, { method: "POST", body: file });
      return answer.ok ? "" : await answer.text();
    } catch {
      return "The file could not be sent; is the server still running?";
    }
  },
  download(address) {
    const link = Object.assign(document.createElement("a"), { href: address, download: "" });
    document.body.append(link);
    link.click();
    link.remove();
  },
  mark(name, on) {
    document.body.classList.toggle(name, on);
  },
  setQuery(query) {
    history.replaceState(null, "", `${location.pathname}?${query}${location.hash}`);
  },
  // The push that is shown is the browser's own matter, and stands in the address as its fragment.
  linkPush() {
    const push = this.face.linked.name;
    if (push === pushInAddress()) return;
    const fragment = push ? `#${new URLSearchParams({ push })}` : "";
    history.replaceState(null, "", `${location.pathname}${location.search}${fragment}`);
  },
  async copyLink() {
    try {
      await navigator.clipboard.writeText(location.href);
    } catch {
      window.prompt("The link of this page:", location.href);
    }
  },
};

const pushInAddress = () => new URLSearchParams(location.hash.slice(1)).get("push") ?? "";
window.addEventListener("hashchange", () => {
  const { face } = wingbeatPage;
  const push = pushInAddress();
  if (!face || push === face.linked.name) return;
  face.linked.want(push);
  if (push) face.linked.heard();
  else face.viewer?.pushes.reset();
});

// While a text is typed but not entered yet, the answer belongs to an earlier request.
const typing = (is) => (event) => {
  if (event.target.matches?.('.drawer input[type="text"]')) document.body.classList.toggle("typing", is);
};
document.addEventListener("input", typing(true));
document.addEventListener("change", typing(false));
document.addEventListener("focusout", typing(false));

// The drawer begins below the first row of the head, which is taller while two messages stand in it.
function watchHead() {
  const status = document.querySelector(".status");
  const tell = () => {
    const below = Math.max(49, Math.ceil(status.getBoundingClientRect().bottom) + 9);
    document.body.style.setProperty("--head", `${below}px`);
  };
  new ResizeObserver(tell).observe(status);
}

// A control whose value is refused is brought to view with all that it is folded into, and one sentence at the top says
// what is wrong.
function watchRefusals() {
  const line = document.querySelector(".refusal");
  let before = [];
  const look = () => {
    const refused = [...document.querySelectorAll('[aria-invalid="true"]')];
    for (const control of refused.filter((each) => !before.includes(each))) {
      for (let fold = control.closest("details"); fold; fold = fold.parentElement.closest("details")) fold.open = true;
      control.scrollIntoView({ block: "nearest" });
    }
    before = refused;
    const text = refused.length ? refusal(refused) : "";
    if (line.textContent !== text) line.textContent = text;
    line.classList.toggle("hidden", !refused.length);
  };
  const watcher = new MutationObserver(look);
  const what = { subtree: true, childList: true, characterData: true, attributes: true, attributeFilter: ["aria-invalid"] };
  for (const place of document.querySelectorAll(".drawer, .curve")) watcher.observe(place, what);
  look();
}

function refusal([control, ...others]) {
  const label = control.getAttribute("aria-label") ?? control.labels[0].textContent;
  const fault = control.closest(".field").querySelector(".fault").textContent;
  const more = others.length ? ` ${others.length === 1 ? "Another choice is" : `${others.length} other choices are`} refused, too.` : "";
  return `${label}: ${fault.replace(/\.$/, "")}.${more}`;
}

// Escape closes drawer and menu; a click elsewhere closes the menu.
const shut = (fold) => {
  if (fold.contains(document.activeElement)) fold.querySelector("summary").focus();
  fold.open = false;
};
document.addEventListener("keydown", (event) => {
  const fold = event.key === "Escape" && event.target.closest?.(".menu[open], .drawer[open]");
  if (fold) shut(fold);
});
document.addEventListener("pointerdown", (event) => {
  const menu = document.querySelector(".menu[open]");
  if (menu && !menu.contains(event.target)) shut(menu);
});
