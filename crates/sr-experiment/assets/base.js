// What all parts of the page use: elements, data, numbers.

const $ = (id) => document.getElementById(id);

// The JSON that an element of the page holds.
const dataOf = (id) => {
  const element = $(id);
  return element ? JSON.parse(element.textContent) : null;
};

// An element with properties, attributes (in `attrs`) and children.
const make = (tag, properties = {}, ...children) => {
  const element = document.createElement(tag);
  const { attrs = {}, ...rest } = properties;
  Object.assign(element, rest);
  for (const [name, value] of Object.entries(attrs)) element.setAttribute(name, value);
  element.append(...children);
  return element;
};

// A button with text.
const button = (text, onclick, attrs = {}) =>
  make("button", { type: "button", textContent: text, onclick, attrs });

// Three digits, as the tables have them.
const threeDigits = (x) => {
  const a = Math.abs(x);
  if (!(a > 0) || !Number.isFinite(x)) return x === 0 ? "0" : String(x);
  if (a >= 0.01 && a < 1000) return x.toFixed(Math.min(4, Math.max(0, 2 - Math.floor(Math.log10(a)))));
  return x.toExponential(2).replace("e+", "e");
};

// The colour that a variable of the style sheet has now.
const ink = (() => {
  const probe = make("span", { hidden: true });
  return (name) => {
    if (!probe.isConnected) document.body.append(probe);
    probe.style.color = `var(${name})`;
    return getComputedStyle(probe).color;
  };
})();

const clamp = (x, low, high) => Math.min(high, Math.max(low, x));
