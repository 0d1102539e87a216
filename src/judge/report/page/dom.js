// Elements, and numbers as text.

// Children are nodes, and texts, which are never parsed as markup. Attributes that are null or false are left out.
export function element(name, attributes = {}, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === true) made.setAttribute(key, "");
    else if (value !== null && value !== false && value !== undefined) made.setAttribute(key, value);
  }
  made.append(...children);
  return made;
}

export const byId = (id) => document.getElementById(id);

// All digits, as in a look file.
export const plain = (value) => String(value);

// At most four digits; "none" for null, which stands for numbers that are not finite.
export function short(value) {
  if (value === null || value === undefined) return "none";
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e-3 && size < 1e5 ? String(Number(value.toPrecision(4))) : value.toExponential(2);
}

// The number in a text, undefined if it has none.
export function numberOf(text) {
  const trimmed = text.trim().replace(/^\+/, "");
  return trimmed === "" || !Number.isFinite(Number(trimmed)) ? undefined : Number(trimmed);
}

export const clamp = (value, least, most) => Math.min(Math.max(value, least), most);
