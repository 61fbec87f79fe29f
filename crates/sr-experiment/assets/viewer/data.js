// Numbers of pictures: text of the page to floats. `planes.rs` says how they were packed.

const planeCache = new Map();

// A promise of the floats of one or several planes, one after the other.
const planeOf = (number) => {
  if (!planeCache.has(number)) planeCache.set(number, unpack($(`plane-${number}`).textContent));
  return planeCache.get(number);
};

const unpack = async (text) => {
  const letters = atob(text);
  const packed = new Uint8Array(letters.length);
  for (let i = 0; i < packed.length; i++) packed[i] = letters.charCodeAt(i);
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"));
  const dealt = new Uint8Array(await new Response(stream).arrayBuffer());
  const count = dealt.length / 4;
  const bytes = new Uint8Array(dealt.length);
  for (let part = 0; part < 4; part++) {
    const start = part * count;
    for (let i = 0; i < count; i++) bytes[4 * i + part] = dealt[start + i];
  }
  return new Float32Array(bytes.buffer);
};

// A picture with its numbers.
const load = async (view) => {
  const optional = (n) => (n === null ? null : planeOf(n));
  const [rgb, flip, samples, seconds] = await Promise.all([
    planeOf(view.rgb),
    optional(view.flip),
    optional(view.samples),
    optional(view.seconds),
  ]);
  const maps = await Promise.all(view.maps.map(async ([name, source]) => [name, await picture(source)]));
  return { ...view, rgb, flip, samples, seconds, maps: new Map(maps) };
};

const picture = async (source) => {
  const image = new Image();
  image.src = source;
  await image.decode();
  return image;
};

// The fewest digits that are this float and no other.
const exact = (x) => {
  if (!Number.isFinite(x) || x === 0) return String(x);
  for (let digits = 1; digits < 9; digits++) {
    const text = x.toPrecision(digits);
    if (Math.fround(Number(text)) === x) return String(Number(text));
  }
  return String(Number(x.toPrecision(9)));
};
