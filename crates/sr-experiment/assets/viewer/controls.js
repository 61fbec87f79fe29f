// The viewer: what is shown and how, with its buttons.

const LAYOUTS = [
  ["grid", "side by side"],
  ["split", "split"],
  ["one", "flip"],
];

class Viewer {
  constructor(element, model) {
    this.element = element;
    this.model = model;
    this.camera = new Camera(() => this.redraw());
    this.readout = new Readout(this);
    this.colours = coloursOf(model.magma);
    this.rasters = new Map();
    this.layout = "grid";
    this.kind = "picture";
    this.stops = { picture: model.exposure, map: 0 };
    this.panes = [];
  }

  async start() {
    this.bar = make("div", { className: "bar" });
    this.chips = make("div", { className: "chips", attrs: { role: "group", "aria-label": "pictures" } });
    this.area = make("div", { className: "panes" });
    this.element.append(this.bar, this.chips, this.area, this.readout.element, this.help());
    this.controls();
    await this.choose(0);
    this.element.hidden = false;
    new ResizeObserver(() => this.redraw()).observe(this.area);
    document.addEventListener("themechange", () => this.redraw());
    listenForKeys(this);
  }

  controls() {
    const { sets } = this.model;
    if (sets.length > 1) {
      const options = sets.map((s, i) => make("option", { value: i, textContent: s.heading || `${i + 1}` }));
      const select = make("select", { className: "sets", onchange: () => this.choose(Number(select.value)) }, ...options);
      this.bar.append(make("label", {}, "of ", select));
    }
    const layouts = LAYOUTS.map(([name, title]) =>
      button(title, () => this.arrange(name), { "data-layout": name }),
    );
    this.bar.append(make("div", { className: "segments", attrs: { role: "group", "aria-label": "layout" } }, ...layouts));
    this.kinds_ = make("select", { className: "kinds", onchange: () => this.showKind(this.kinds_.value) });
    this.bar.append(make("label", {}, "show ", this.kinds_));
    this.slider = make("input", { type: "range", min: -12, max: 12, step: 0.1, className: "stops" });
    this.slider.oninput = () => this.expose(Number(this.slider.value));
    this.output = make("output");
    this.sliderName = make("span", { textContent: "exposure " });
    this.bar.append(make("label", {}, this.sliderName, this.slider, this.output));
    this.legend = make("span", { className: "scale", hidden: true });
    this.bar.append(
      this.legend,
      button("fit", () => this.camera.fit(), { title: "the whole pictures (0)" }),
      button("1 : 1", () => this.actualSize(), { title: "a pixel of the picture as one of the screen" }),
    );
  }

  help() {
    const keys = [
      ["1 … 9", "flip to a picture; in the split the left one, with Shift the right one"],
      ["r", "flip to the reference; let go of it with the key of a picture"],
      ["← ↑ ↓ →", "move"],
      ["+ −, wheel, pinch", "zoom; the wheel once the viewer was clicked, or with Ctrl"],
      ["0", "the whole pictures"],
      ["[ ]", "exposure, or the range of a map"],
      ["e", "the next kind of map; with Shift the one before"],
      ["g s o", "side by side, split, one at a time"],
    ];
    const rows = keys.flatMap(([key, what]) => [make("dt", {}, make("kbd", { textContent: key })), make("dd", { textContent: what })]);
    return make("details", { className: "keys" }, make("summary", { textContent: "Keys" }), make("dl", {}, ...rows));
  }

  // Other pictures.
  async choose(number) {
    const { pictures, reference } = this.model.sets[number];
    const loaded = await Promise.all(pictures.map(load));
    this.set = { pictures: loaded, reference: reference === null ? null : loaded[reference] };
    this.kinds = kindsOf(this.set, this.model.offsets);
    if (!this.kinds.has(this.kind)) this.kind = "picture";
    this.kinds_.replaceChildren(...[...this.kinds].map(([value, k]) => make("option", { value, textContent: k.title })));
    this.visible = new Set(loaded);
    this.current = loaded[0];
    this.pair = [loaded[0], this.set.reference ?? loaded[loaded.length - 1]];
    this.rasters.clear();
    this.listChips();
    this.readout.reset();
    this.showKind(this.kind);
    this.arrange(this.layout);
  }

  // A chip a picture, with its key.
  listChips() {
    const runs = this.set.pictures.filter((v) => v !== this.set.reference);
    const chips = this.set.pictures.map((view) => {
      const key = view === this.set.reference ? "r" : String(runs.indexOf(view) + 1);
      const chip = button("", (event) => this.pick(view, event.shiftKey));
      if (key.length === 1) chip.append(make("kbd", { textContent: key }), " ");
      chip.append(view.label);
      chip.view = view;
      return chip;
    });
    this.chips.replaceChildren(...chips);
  }

  // What a click on a chip or a key means depends on the layout.
  pick(view, right = false) {
    if (this.layout === "one") this.current = view;
    if (this.layout === "split") this.pair[right ? 1 : 0] = view;
    if (this.layout === "grid") {
      const visible = this.visible;
      if (visible.has(view) && visible.size > 1) visible.delete(view);
      else visible.add(view);
    }
    this.arrange(this.layout);
  }

  // One picture in the place of the one before.
  flip(view) {
    this.current = view;
    this.arrange("one");
  }

  arrange(layout) {
    this.layout = layout;
    for (const b of this.bar.querySelectorAll("[data-layout]")) {
      b.setAttribute("aria-pressed", String(b.dataset.layout === layout));
    }
    const shown = {
      grid: () => this.set.pictures.filter((v) => this.visible.has(v)).map((v) => [v]),
      split: () => [this.pair],
      one: () => [[this.current]],
    }[layout]();
    this.panes = shown.map((views) => new Pane(this, views));
    this.area.dataset.layout = layout;
    // As even as can be: five as three and two.
    const rows = Math.ceil(shown.length / 4);
    this.area.style.setProperty("--panes", Math.ceil(shown.length / rows));
    this.area.replaceChildren(...this.panes.map((p) => p.figure));
    const pressed = new Set(shown.flat());
    for (const chip of this.chips.children) chip.setAttribute("aria-pressed", String(pressed.has(chip.view)));
    this.redraw();
  }

  showKind(name) {
    this.kind = name;
    this.kinds_.value = name;
    const kind = this.kinds.get(name);
    this.sliderName.textContent = name === "picture" ? "exposure " : "range ";
    this.slider.disabled = Boolean(kind.image);
    this.expose(this.stops[name === "picture" ? "picture" : "map"]);
  }

  expose(stops) {
    const kind = this.kinds.get(this.kind);
    this.stops[this.kind === "picture" ? "picture" : "map"] = stops;
    this.slider.value = stops;
    this.output.textContent = `${stops > 0 ? "+" : ""}${Number(stops).toFixed(1)}`;
    this.legend.hidden = !kind.value;
    if (kind.value) {
      const [low, high] = rangeOf(kind, stops).map(threeDigits);
      this.legend.replaceChildren(low, make("span", { className: "ramp" }), high + (kind.unit ?? ""));
    }
    this.rasters.clear();
    this.redraw();
  }

  // Pictures in colours are kept until what is shown changes.
  raster(view) {
    if (!this.rasters.has(view)) {
      const kind = this.kinds.get(this.kind);
      const stops = this.stops[this.kind === "picture" ? "picture" : "map"];
      this.rasters.set(view, rasterOf(view, kind, stops, this.colours));
    }
    return this.rasters.get(view);
  }

  actualSize() {
    const [pane] = this.panes;
    const { scale } = this.camera.place(pane.views[0].width, pane.views[0].height, pane.canvas);
    this.camera.zoomAt(this.camera.x, this.camera.y, 1 / scale);
  }

  isActive() {
    return this.element.contains(document.activeElement);
  }

  redraw() {
    for (const pane of this.panes) pane.draw();
  }
}
