// Plots with values under the pointer: uPlot draws, over the numbers that the page holds.

const startPlots = () => {
  const panels = dataOf("data-panels");
  const figures = [...document.querySelectorAll("figure.plot")];
  const plots = figures.map((figure) => new Plot(figure, panels[Number(figure.dataset.panel)]));
  // A contender that is put away is put away in all plots of its group.
  const toggle = (group, place) => {
    const same = plots.filter((p) => p.panel.group === group);
    const hidden = same.some((p) => p.hidden.has(place));
    for (const plot of same) plot.show(place, hidden);
  };
  for (const plot of plots) plot.start(toggle);
  document.addEventListener("themechange", () => plots.forEach((p) => p.draw()));
};

class Plot {
  constructor(figure, panel) {
    this.figure = figure;
    this.panel = panel;
    this.hidden = new Set();
    this.place = make("div", { className: "live" });
    this.tip = make("div", { className: "tip", hidden: true, attrs: { role: "status" } });
    this.legend = make("div", { className: "legend" });
  }

  start(toggle) {
    const { panel } = this;
    for (const series of panel.series) {
      const line = make("span", { className: "swatch" });
      line.style.setProperty("--ink", `var(--c${series.place % 8})`);
      if (series.place >= 8) line.classList.add("dashed");
      const item = make("button", {
        type: "button",
        title: "show or hide",
        attrs: { "aria-pressed": "true", "data-place": series.place },
        onclick: () => toggle(panel.group, series.place),
      });
      item.append(line, make("b", { textContent: series.label }));
      if (series.slope) item.append(make("span", { className: "slope", textContent: series.slope }));
      this.legend.append(item);
    }
    this.figure.append(this.place, this.legend);
    this.figure.classList.add("is-live");
    new ResizeObserver(() => this.draw()).observe(this.place);
  }

  show(place, visible) {
    if (visible) this.hidden.delete(place);
    else this.hidden.add(place);
    const item = this.legend.querySelector(`[data-place="${place}"]`);
    if (item) item.setAttribute("aria-pressed", String(visible));
    const index = this.panel.series.findIndex((s) => s.place === place);
    if (index >= 0 && this.u) this.u.setSeries(index + 1, { show: visible });
    this.tip.hidden = true;
  }

  // Anew, at the size and in the colours that the page has now.
  draw() {
    const width = this.place.clientWidth;
    if (width === 0) return;
    if (this.u) this.u.destroy();
    const { series } = this.panel;
    const data = uPlot.join(series.map((s) => [s.points.map((p) => p.x), s.points.map((p) => p.y)]));
    this.u = new uPlot(this.options(width), data, this.place);
    this.u.over.append(this.tip);
    this.tip.hidden = true;
  }

  options(width) {
    const axis = (label) => ({
      label,
      labelSize: 22,
      labelFont: "13px system-ui, sans-serif",
      font: "12px system-ui, sans-serif",
      stroke: ink("--ink"),
      grid: { stroke: ink("--line"), width: 1 },
      ticks: { stroke: ink("--line"), width: 1 },
      splits: (u, i, low, high) =>
        i === 0 && this.panel.by === "samples" ? doublings(low, high, width / 60) : logTicks(low, high, i === 0 ? width / 80 : 8),
      filter: (u, splits) => splits,
      values: (u, splits) => splits.map(tickLabel),
    });
    const scale = { distr: 3, log: 10, time: false, range: (u, low, high) => roomAround(low, high) };
    const y = { ...scale, range: (u, low, high) => roomAround(...this.withIntervals(low, high)) };
    return {
      width,
      height: clamp(Math.round(0.66 * width), 240, 430),
      legend: { show: false },
      cursor: { drag: { x: true, y: true, uni: 20 }, points: { show: false }, y: true },
      scales: { x: scale, y },
      axes: [axis(this.panel.x_title), { ...axis(this.panel.metric), size: 62 }],
      series: [{}, ...this.panel.series.map((s) => this.line(s))],
      hooks: { drawSeries: [(u, i) => this.bars(u, i)], setCursor: [(u) => this.hover(u)] },
    };
  }

  // Unless somebody has zoomed in, the ends of the intervals are to be seen too; what is below a tenth
  // of its mean has no place on a logarithmic axis.
  withIntervals(low, high) {
    const points = this.panel.series.filter((s) => !this.hidden.has(s.place)).flatMap((s) => s.points);
    const values = points.map((p) => p.y);
    if (low > Math.min(...values) || high < Math.max(...values)) return [low, high];
    const ends = points.flatMap((p) => [p.y, p.high ?? p.y, p.low > 0.1 * p.y ? p.low : p.y]);
    return [Math.min(...ends), Math.max(...ends)];
  }

  line(series) {
    const colour = ink(`--c${series.place % 8}`);
    return {
      label: series.label,
      stroke: colour,
      width: 2,
      dash: series.place >= 8 ? [8, 4] : undefined,
      spanGaps: true,
      show: !this.hidden.has(series.place),
      points: { show: true, size: 6, fill: colour, stroke: colour },
    };
  }

  // Intervals, over the line: a light band and a bar a point.
  bars(u, index) {
    const series = this.panel.series[index - 1];
    if (!series || !u.series[index].show) return;
    const points = series.points.filter((p) => p.low !== null && p.high !== null);
    if (points.length === 0) return;
    const floor = u.scales.y.min;
    const at = (x, y) => [u.valToPos(x, "x", true), u.valToPos(Math.max(y, floor), "y", true)];
    const { ctx } = u;
    const { left, top, width, height } = u.bbox;
    ctx.save();
    ctx.beginPath();
    ctx.rect(left, top, width, height);
    ctx.clip();
    ctx.fillStyle = ctx.strokeStyle = ink(`--c${series.place % 8}`);
    ctx.globalAlpha = 0.13;
    ctx.beginPath();
    for (const p of points) ctx.lineTo(...at(p.x, p.low));
    for (const p of [...points].reverse()) ctx.lineTo(...at(p.x, p.high));
    ctx.fill();
    ctx.globalAlpha = 0.7;
    ctx.lineWidth = devicePixelRatio;
    ctx.setLineDash([]);
    ctx.beginPath();
    const cap = 3 * devicePixelRatio;
    for (const p of points) {
      const [x, low] = at(p.x, p.low);
      const [, high] = at(p.x, p.high);
      ctx.moveTo(x, low);
      ctx.lineTo(x, high);
      for (const y of p.low > floor ? [low, high] : [high]) {
        ctx.moveTo(x - cap, y);
        ctx.lineTo(x + cap, y);
      }
    }
    ctx.stroke();
    ctx.restore();
  }

  // The nearest point tells its numbers.
  hover(u) {
    const { left, top } = u.cursor;
    let best = null;
    if (left >= 0) {
      this.panel.series.forEach((series, i) => {
        if (!u.series[i + 1].show) return;
        for (const p of series.points) {
          const x = u.valToPos(p.x, "x");
          const y = u.valToPos(p.y, "y");
          const distance = Math.hypot(x - left, y - top);
          if (distance < 40 && (!best || distance < best.distance)) best = { series, p, x, y, distance };
        }
      });
    }
    this.tip.hidden = !best;
    if (!best) return;
    const { series, p, x, y } = best;
    const half = p.high === null ? "" : ` ± ${threeDigits(p.high - p.y)}`;
    this.tip.replaceChildren(
      make("b", { textContent: series.label }),
      make("div", { textContent: `${this.panel.metric} ${threeDigits(p.y)}${half}` }),
      make("div", { textContent: `${p.samples} samples, ${threeDigits(p.seconds)} s` }),
      make("div", { textContent: p.seeds === 1 ? "1 seed" : `${p.seeds} seeds` }),
    );
    this.tip.style.setProperty("--ink", `var(--c${series.place % 8})`);
    const { clientWidth: w, clientHeight: h } = u.over;
    const { offsetWidth: tw, offsetHeight: th } = this.tip;
    this.tip.style.left = `${clamp(x + 12 + tw > w ? x - tw - 12 : x + 12, 0, Math.max(0, w - tw))}px`;
    this.tip.style.top = `${clamp(y - th - 8, 0, Math.max(0, h - th))}px`;
  }
}

// A little beyond the values at either end; one value alone gets some room.
const roomAround = (low, high) => {
  if (!(low > 0 && high > 0)) return [0.1, 1];
  const lacking = Math.max(0, 0.4 - Math.log10(high / low)) / 2;
  const by = 10 ** (lacking + 0.06 * (Math.log10(high / low) + 2 * lacking));
  return [low / by, high * by];
};

// Marks: powers of ten, and between them where there is room.
const logTicks = (low, high, room) => {
  const decades = Math.log10(high / low);
  const all =
    decades < 0.7 ? [1, 1.5, 2, 3, 4, 5, 6, 8] : decades < 1.3 ? [1, 2, 3, 5] : decades < 2.5 ? [1, 2, 5] : [1];
  const multiples = decades * all.length > 1.5 * room ? [1] : all;
  const first = Math.floor(Math.log10(low));
  const last = Math.ceil(Math.log10(high));
  const stride = Math.max(1, Math.ceil((last - first) / Math.max(2, room)));
  const ticks = [];
  for (let e = first; e <= last; e++) {
    if (e % stride !== 0) continue;
    for (const m of multiples) {
      const tick = Number(`${m}e${e}`);
      if (tick >= low && tick <= high) ticks.push(tick);
    }
  }
  return ticks;
};

// Powers of two, at which samples are logged.
const doublings = (low, high, room) => {
  const first = Math.ceil(Math.log2(low));
  const last = Math.floor(Math.log2(high));
  const stride = Math.floor((last - first) / Math.max(2, room)) + 1;
  const ticks = [];
  for (let e = first; e <= last; e++) if (e % stride === 0) ticks.push(2 ** e);
  return ticks;
};

const tickLabel = (x) => {
  const exponent = Math.floor(Math.log10(x) + 1e-9);
  if (exponent >= -3 && exponent < 5) return String(Number(x.toPrecision(5)));
  const digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
  const power = String(exponent).replace(/\d/g, (d) => digits[d]).replace("-", "⁻");
  const multiple = Number((x / 10 ** exponent).toPrecision(2));
  return multiple === 1 ? `10${power}` : `${multiple}·10${power}`;
};
