// Keys of the viewer, while it has the focus; fields keep theirs.

const listenForKeys = (viewer) => {
  const { camera } = viewer;
  const step = 0.1;
  const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  const layouts = { g: "grid", s: "split", o: "one" };
  const picture = (event) => {
    // The digit's key, whatever Shift makes of it.
    const digit = /^Digit([1-9])$/.exec(event.code)?.[1] ?? (/^[1-9]$/.test(event.key) ? event.key : null);
    if (event.key === "r") return viewer.set.reference;
    const runs = viewer.set.pictures.filter((v) => v !== viewer.set.reference);
    return digit ? (runs[Number(digit) - 1] ?? null) : null;
  };
  const nextKind = (by) => {
    const names = [...viewer.kinds.keys()];
    viewer.showKind(names[(names.indexOf(viewer.kind) + by + names.length) % names.length]);
  };
  const act = (event) => {
    const view = picture(event);
    if (view && viewer.layout === "split") return viewer.pick(view, event.shiftKey);
    if (view) return viewer.flip(view);
    if (event.key in move) return camera.pan(...move[event.key].map((v) => (v * step) / camera.zoom));
    if (event.key in layouts) return viewer.arrange(layouts[event.key]);
    switch (event.key) {
      case "+":
      case "=":
        return camera.zoomAt(camera.x, camera.y, 1.25);
      case "-":
        return camera.zoomAt(camera.x, camera.y, 0.8);
      case "0":
        return camera.fit();
      case "[":
      case "]":
        return viewer.expose(clamp(Number(viewer.slider.value) + (event.key === "]" ? 0.5 : -0.5), -12, 12));
      case "e":
      case "E":
        return nextKind(event.shiftKey ? -1 : 1);
      default:
        return false;
    }
  };
  viewer.element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.matches("select, input")) return;
    if (act(event) !== false) event.preventDefault();
  });
};
