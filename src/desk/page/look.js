// The values of a look with settings, as the tool computes them. The order of settings counts: an absorption makes the
// water custom, and a water_type that is set later wins. So settings are an object, whose keys keep their order; all
// functions return new objects and change none.

export const same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

export class Looks {
  // As in the answer of api/desk.
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
      if (!field) continue;  // the tool reports it
      values.set(key, value);
      for (const condition of field.used_when) {
        const other = `${field.operator}.${condition.key}`;
        if (condition.follows && !holds(condition, values, field.operator)) values.set(other, condition.words[0]);
      }
    }
    return values;
  }

  // Why no model reads that parameter, in words; "" if it is read. Conditions that setting it would fulfil do not
  // count.
  unused(key, values) {
    const field = this.fields.get(key);
    return field.used_when.filter((condition) => !condition.follows && !holds(condition, values, field.operator))
        .map((condition) => condition.text).join(" and ");
  }

  // The other parameter that setting it changes: "water_type = case_1", or "".
  brings(key, values) {
    const field = this.fields.get(key);
    return field.used_when.filter((condition) => condition.follows && !holds(condition, values, field.operator))
        .map((condition) => `${condition.key} = ${condition.words[0]}`).join(", ");
  }

  // The settings with one more at the end.
  with(set, key, value) {
    const {[key]: before, ...rest} = set;
    return {...rest, [key]: value};
  }

  // The settings with the look's own value of that parameter, which is set explicitly if another setting changes it.
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
