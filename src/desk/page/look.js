// What a look and the settings on top of it come to, as the tool sees it. A setting's place counts: an absorption makes
// the water custom, and a water_type that is set later wins. So settings are a list in the order of their making, held
// by an object (whose keys keep that order); all functions return new ones and change nothing.

export const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export class Looks {
  // As api/desk describes them.
  constructor({looks, operators}) {
    this.looks = new Map(looks.map(({name, values}) => [name, values]));
    this.fields = new Map(operators.flatMap((operator) =>
        operator.fields.map((field) => [`${operator.name}.${field.name}`, {...field, operator: operator.name}])));
  }

  // The look's own value.
  own(look, key) {
    const {operator, name} = this.fields.get(key);
    return this.looks.get(look)[operator][name];
  }

  // All values of a state {look, set}, by key.
  values({look, set}) {
    const values = new Map([...this.fields.keys()].map((key) => [key, this.own(look, key)]));
    for (const [key, value] of Object.entries(set)) {
      const field = this.fields.get(key);
      if (!field) continue;  // the tool will say so
      values.set(key, value);
      for (const condition of field.used_when) {
        const other = `${field.operator}.${condition.key}`;
        if (condition.follows && !holds(condition, values, field.operator)) values.set(other, condition.words[0]);
      }
    }
    return values;
  }

  // Why nothing reads that parameter, in words; "" where it is read. What setting it would bring by itself is no
  // reason.
  unused(key, values) {
    const field = this.fields.get(key);
    return field.used_when.filter((condition) => !condition.follows && !holds(condition, values, field.operator))
        .map((condition) => condition.text).join(" and ");
  }

  // What setting it brings besides: "water_type = case_1", or "".
  brings(key, values) {
    const field = this.fields.get(key);
    return field.used_when.filter((condition) => condition.follows && !holds(condition, values, field.operator))
        .map((condition) => `${condition.key} = ${condition.words[0]}`).join(", ");
  }

  // The settings with one more, which is the last.
  with(set, key, value) {
    const {[key]: before, ...rest} = set;
    return {...rest, [key]: value};
  }

  // The settings with that parameter as the look has it. Where another setting changes it, too, it is set to that.
  without({look, set}, key) {
    const {[key]: before, ...rest} = set;
    const own = this.own(look, key);
    return same(this.values({look, set: rest}).get(key), own) ? rest : {...rest, [key]: own};
  }
}

function holds(condition, values, operator) {
  const {key, words, or_above_zero} = condition;
  if (or_above_zero && values.get(`${operator}.${or_above_zero}`) > 0) return true;
  return words.includes(String(values.get(`${operator}.${key}`)));
}
