// The position of a value on a slider. Many ranges end far beyond any water (a wind of 30, but a period of 1e9): a slider
// then reaches from 0 to a hundred times the look's own value, and typed numbers may lie beyond it.

const wide = 20;     // a range of more times the look's value is not linear
const reach = 100;   // times the look's value: the end of a slider
export const steps = 1000;

const digits = (value, count) => Number(value.toPrecision(count));

// Linear, in steps of a power of ten.
function linear(least, most) {
  const step = 10 ** Math.floor(Math.log10((most - least) / steps * 2));
  return {
    position: (value) => (value - least) / (most - least),
    value: (position) => {
      const places = Math.max(0, -Math.round(Math.log10(step)));
      return Number((Math.round((least + position * (most - least)) / step) * step).toFixed(places));
    },
  };
}

// Logarithmic: each step is a fixed ratio.
function logarithmic(least, most) {
  const ratio = Math.log(most / least);
  return {
    position: (value) => Math.log(Math.max(value, least) / least) / ratio,
    value: (position) => digits(least * Math.exp(position * ratio), 3),
  };
}

// Linear around zero, logarithmic far from it. `near` is the transition.
function aroundZero(least, most, near) {
  const low = Math.asinh(least / near), high = Math.asinh(most / near);
  return {
    position: (value) => (Math.asinh(value / near) - low) / (high - low),
    value: (position) => digits(near * Math.sinh(low + position * (high - low)), 3) + 0,
  };
}

// The scale of a field with the ends `least` and `most` (null: none) and the look's value `own`.
export function scaleOf(least, most, own) {
  const size = Math.abs(own) || Math.min(1, most ?? 1);
  const low = Math.max(least ?? -Infinity, -reach * size), high = Math.min(most ?? Infinity, reach * size);
  if (low > 0) return high > wide * low ? logarithmic(Math.max(low, size / reach), high) : linear(low, high);
  const isCyclic = least === -360;
  return isCyclic || high - low <= wide * size || (own === 0 && most - least <= 100)
      ? linear(low, high) : aroundZero(low, high, size / 4);
}
