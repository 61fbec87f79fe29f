// From numbers to colours of the screen.

// The sRGB curve (IEC 61966-2-1) in 4096 steps, which is finer than the screen's 256.
const SRGB = Uint8ClampedArray.from({ length: 4097 }, (_, i) => {
  const v = i / 4096;
  return 255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - 0.055);
});

// Pixels that are not finite, as in all maps of the program.
const NOT_FINITE = [0, 160, 0];

// Hexadecimal colours without a space between them.
const coloursOf = (text) =>
  Array.from({ length: text.length / 6 }, (_, i) =>
    [0, 2, 4].map((k) => parseInt(text.slice(6 * i + k, 6 * i + k + 2), 16)),
  );

// A picture, exposed by stops.
const paintPicture = (out, rgb, stops) => {
  const n = rgb.length / 3;
  const scale = 4096 * 2 ** stops;
  for (let i = 0; i < n; i++) {
    const r = rgb[i];
    const g = rgb[n + i];
    const b = rgb[2 * n + i];
    const finite = Number.isFinite(r) && Number.isFinite(g) && Number.isFinite(b);
    out[4 * i] = finite ? SRGB[clamp(Math.round(scale * r), 0, 4096)] : NOT_FINITE[0];
    out[4 * i + 1] = finite ? SRGB[clamp(Math.round(scale * g), 0, 4096)] : NOT_FINITE[1];
    out[4 * i + 2] = finite ? SRGB[clamp(Math.round(scale * b), 0, 4096)] : NOT_FINITE[2];
    out[4 * i + 3] = 255;
  }
};

// A map: each value, as a part of the way through the colours.
const paintMap = (out, count, part, colours) => {
  for (let i = 0; i < count; i++) {
    const t = part(i);
    const colour = Number.isNaN(t) ? NOT_FINITE : colours[Math.round(clamp(t, 0, 1) * (colours.length - 1))];
    out[4 * i] = colour[0];
    out[4 * i + 1] = colour[1];
    out[4 * i + 2] = colour[2];
    out[4 * i + 3] = 255;
  }
};
