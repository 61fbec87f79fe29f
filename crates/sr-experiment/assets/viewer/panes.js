// Canvases that show pictures: each one, or two with a border between them that can be moved.

class Pane {
  // `views` has one picture, or the left and the right one.
  constructor(viewer, views) {
    this.viewer = viewer;
    this.views = views;
    this.split = 0.5;
    this.pointers = new Map();
    this.canvas = make("canvas", { attrs: { "aria-label": views.map((v) => v.label).join(" and ") } });
    this.canvas.style.aspectRatio = `${views[0].width} / ${views[0].height}`;
    const frame = make("div", { className: "frame" }, this.canvas);
    if (views.length > 1) frame.append(this.handle());
    const caption = make("figcaption", {}, ...views.map((v, i) => this.name(v, i)));
    this.figure = make("figure", { className: "pane" }, frame, caption);
    this.listen();
  }

  name(view, i) {
    const name = make("span", { className: this.views.length > 1 ? ["left", "right"][i] : "" });
    const swatch = make("span", { className: "dot" });
    if (view.place !== null) swatch.style.setProperty("--ink", `var(--c${view.place % 8})`);
    name.append(swatch, make("b", { textContent: view.label }));
    if (view.caption && this.views.length === 1) name.append(make("small", { textContent: view.caption }));
    return name;
  }

  // The border between two pictures.
  handle() {
    const handle = make("div", {
      className: "handle",
      tabIndex: 0,
      attrs: { role: "slider", "aria-label": "border", "aria-valuemin": 0, "aria-valuemax": 100 },
    });
    const move = (to) => {
      this.split = clamp(to, 0, 1);
      handle.style.left = `${100 * this.split}%`;
      handle.setAttribute("aria-valuenow", Math.round(100 * this.split));
      this.draw();
    };
    handle.addEventListener("pointerdown", (event) => {
      handle.setPointerCapture(event.pointerId);
      event.stopPropagation();
    });
    handle.addEventListener("pointermove", (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = this.canvas.getBoundingClientRect();
      move((event.clientX - box.left) / box.width);
    });
    handle.addEventListener("keydown", (event) => {
      const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
      if (step === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      move(this.split + step);
    });
    handle.style.left = "50%";
    handle.setAttribute("aria-valuenow", 50);
    return handle;
  }

  // As many pixels as the screen has in the canvas' place.
  draw() {
    const { canvas } = this;
    const { clientWidth, clientHeight } = canvas;
    if (clientWidth === 0) return;
    const width = Math.round(clientWidth * devicePixelRatio);
    const height = Math.round(clientHeight * devicePixelRatio);
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d");
    context.fillStyle = ink("--shade");
    context.fillRect(0, 0, width, height);
    const border = Math.round(this.split * width);
    this.views.forEach((view, i) => {
      const [from, to] = this.views.length === 1 ? [0, width] : [[0, border], [border, width]][i];
      context.save();
      context.beginPath();
      context.rect(from, 0, to - from, height);
      context.clip();
      this.drawOne(context, view);
      context.restore();
    });
    const { x, y, zoom } = this.viewer.camera;
    canvas.dataset.view = [x, y, zoom].map((v) => v.toFixed(6)).join(" ");
    canvas.style.touchAction = zoom > 1 ? "none" : "pan-x pan-y";
  }

  drawOne(context, view) {
    const raster = this.viewer.raster(view);
    const { left, top, scale } = this.viewer.camera.place(view.width, view.height, this.canvas);
    if (!raster) {
      context.fillStyle = ink("--faint");
      context.font = `${14 * devicePixelRatio}px system-ui, sans-serif`;
      context.fillText("has no such map", left + 12 * devicePixelRatio, top + 26 * devicePixelRatio);
      return;
    }
    // Pixels are squares: nothing is invented between them.
    context.imageSmoothingEnabled = scale < 1;
    context.imageSmoothingQuality = "high";
    context.drawImage(raster, left, top, view.width * scale, view.height * scale);
  }

  // Parts of the picture where something of the page is.
  at(event) {
    const box = this.canvas.getBoundingClientRect();
    const view = this.views[0];
    const { left, top, scale } = this.viewer.camera.place(view.width, view.height, this.canvas);
    const x = ((event.clientX - box.left) / box.width) * this.canvas.width;
    const y = ((event.clientY - box.top) / box.height) * this.canvas.height;
    return [(x - left) / (scale * view.width), (y - top) / (scale * view.height)];
  }

  listen() {
    const { canvas, viewer } = this;
    canvas.addEventListener("wheel", (event) => {
      // A page that scrolls by must not stop here, unless it was asked to.
      if (!viewer.isActive() && !event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      viewer.camera.zoomAt(...this.at(event), 2 ** ((-event.deltaY * lines) / 240));
    }, { passive: false });
    canvas.addEventListener("pointerdown", (event) => {
      viewer.element.focus({ preventScroll: true });
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, event);
    });
    canvas.addEventListener("pointermove", (event) => this.move(event));
    for (const name of ["pointerup", "pointercancel"]) {
      canvas.addEventListener(name, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener("dblclick", (event) => {
      viewer.camera.zoomAt(...this.at(event), viewer.camera.zoom > 1 ? 1 / 400 : 4);
    });
    canvas.addEventListener("pointerleave", () => viewer.readout.tell(null));
  }

  move(event) {
    const { camera, readout } = this.viewer;
    const before = this.pointers.get(event.pointerId);
    if (before) {
      const others = [...this.pointers.values()].filter((p) => p.pointerId !== event.pointerId);
      if (others.length > 0) this.pinch(before, event, others[0]);
      else {
        const [x0, y0] = this.at(before);
        const [x1, y1] = this.at(event);
        if (camera.zoom > 1) camera.pan(x0 - x1, y0 - y1);
      }
      this.pointers.set(event.pointerId, event);
    }
    readout.tell(this.at(event));
  }

  // Two fingers: their distance zooms, around the one that rests.
  pinch(before, now, other) {
    const distance = (p) => Math.hypot(p.clientX - other.clientX, p.clientY - other.clientY);
    const factor = distance(now) / Math.max(1, distance(before));
    this.viewer.camera.zoomAt(...this.at(other), factor);
  }
}
