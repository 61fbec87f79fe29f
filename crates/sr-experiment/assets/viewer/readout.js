// The numbers of the pixel under the pointer, of every picture at once.

class Readout {
  constructor(viewer) {
    this.viewer = viewer;
    this.title = make("p", { className: "pixel" });
    this.body = make("tbody");
    this.head = make("thead");
    this.element = make(
      "div",
      { className: "readout wide", attrs: { "aria-live": "off" } },
      this.title,
      make("table", {}, this.head, this.body),
    );
  }

  // Other pictures: other lines.
  reset() {
    const { set, kinds } = this.viewer;
    const more = [...kinds].filter(([, kind]) => kind.value);
    const heads = ["", "R", "G", "B", ...more.map(([, kind]) => kind.title)];
    this.head.replaceChildren(
      make("tr", {}, ...heads.map((text) => make("th", { textContent: text, attrs: { scope: "col" } }))),
    );
    this.rows = set.pictures.map((view) => {
      const cells = heads.slice(1).map(() => make("td", { textContent: "–" }));
      const head = make("th", { textContent: view.label, attrs: { scope: "row" } });
      this.body.append(make("tr", {}, head, ...cells));
      return { view, cells, more };
    });
    this.body.replaceChildren(...this.rows.map((r) => r.cells[0].parentElement));
    this.tell(null);
  }

  // A place in parts of the pictures, or none.
  tell(place) {
    const inside = place && place.every((v) => v >= 0 && v < 1);
    if (!inside) {
      this.title.textContent = "Point at a picture: its numbers stand here.";
      for (const { cells } of this.rows) for (const cell of cells) cell.textContent = "–";
      return;
    }
    const { origin, factor } = this.viewer.model;
    const first = this.rows[0].view;
    const [px, py] = this.pixel(first, place);
    const at = (v, o) => (factor === 1 ? `${o + v}` : `${o + v * factor}…${o + (v + 1) * factor - 1}`);
    this.title.textContent = `pixel ${at(px, origin[0])}, ${at(py, origin[1])}`;
    for (const { view, cells, more } of this.rows) {
      const [x, y] = this.pixel(view, place);
      const i = y * view.width + x;
      const n = view.width * view.height;
      const rgb = [0, 1, 2].map((c) => exact(view.rgb[c * n + i]));
      const others = more.map(([, kind]) => {
        const value = kind.value(view, i);
        return value === null ? "–" : threeDigits(value) + (kind.unit ?? "");
      });
      [...rgb, ...others].forEach((text, k) => (cells[k].textContent = text));
    }
  }

  pixel(view, [x, y]) {
    return [Math.floor(x * view.width), Math.floor(y * view.height)];
  }
}
