// What can be shown of a picture: itself, its errors, what it took.

// Mean over the channels of what `of` says of each.
const errorOf = (view, reference, i, of) => {
  const n = view.rgb.length / 3;
  let sum = 0;
  for (let c = 0; c < 3; c++) sum += of(view.rgb[c * n + i], reference.rgb[c * n + i]);
  return sum / 3;
};

// Kinds of maps by name. `value` is a pixel's number or `null` when there is none; `range` the ends
// of the colours; `log` says how they are spaced.
const kindsOf = (set, offsets) => {
  const { reference } = set;
  const sameSize = (v) => reference && v !== reference && v.rgb.length === reference.rgb.length;
  const error = (of) => (view, i) => (sameSize(view) ? errorOf(view, reference, i, of) : null);
  const largest = (plane) => {
    let most = 0;
    for (const v of set.pictures) if (v[plane]) for (const x of v[plane]) most = Math.max(most, x);
    return most;
  };
  const plane = (name, title, range, unit) => ({
    title,
    unit,
    range,
    value: (view, i) => (view[name] ? view[name][i] : null),
  });
  const kinds = new Map([["picture", { title: "picture" }]]);
  if (reference) {
    const relative = (x, r) => Math.abs(x - r) / (Math.abs(r) + offsets.relative);
    const squared = (x, r) => (x - r) ** 2 / (r * r + offsets.relmse);
    kinds.set("relative", { title: "error |x − r|/(|r| + 0.01)", range: [0, 1], value: error(relative) });
    kinds.set("squared", { title: "error (x − r)²/(r² + 0.01)", range: [1e-4, 1], log: true, value: error(squared) });
    kinds.set("flip", plane("flip", "FLIP", [0, 1]));
  }
  const any = (name) => set.pictures.some((v) => v[name]);
  if (any("samples")) kinds.set("samples", plane("samples", "samples", [0, largest("samples")]));
  if (any("seconds")) kinds.set("seconds", plane("seconds", "seconds", [0, largest("seconds")], " s"));
  for (const view of set.pictures) {
    for (const name of view.maps.keys()) kinds.set(`same ${name}`, { title: `same? ${name}`, image: name });
  }
  return kinds;
};

// The ends of a map's colours, moved by stops.
const rangeOf = (kind, stops) => {
  const scale = 2 ** -stops;
  return kind.log ? [kind.range[0] * scale, kind.range[1] * scale] : [kind.range[0], kind.range[1] * scale];
};

// What a picture shows as something that a canvas can draw; `null` when it has no such map.
const rasterOf = (view, kind, stops, colours) => {
  if (kind.image) return view.maps.get(kind.image) ?? null;
  const count = view.width * view.height;
  if (kind.value && kind.value(view, 0) === null) return null;
  const canvas = make("canvas", { width: view.width, height: view.height });
  const context = canvas.getContext("2d");
  const image = context.createImageData(view.width, view.height);
  if (!kind.value) {
    paintPicture(image.data, view.rgb, stops);
  } else {
    const [low, high] = rangeOf(kind, stops);
    const part = kind.log
      ? (i) => Math.log(Math.max(kind.value(view, i), 0) / low) / Math.log(high / low)
      : (i) => (kind.value(view, i) - low) / (high - low || 1);
    paintMap(image.data, count, part, colours);
  }
  context.putImageData(image, 0, 0);
  return canvas;
};
