// Every setting of a configuration as a field: what it is, its unit, its range and its default come from the schema of
// configurations. What is not as the preset has it is marked; what is wrong is said beside its field.

// What is chosen elsewhere, or not chosen at all.
const NOT_SET = new Set(["preset", "seed", "creature", "further_bodies", "origin", "topology", "sensors", "stages", "movement.name"]);

class Settings {
  // `change` is given what changes the map of settings.
  constructor(change) {
    this.changeSet = change;
    this.fields = new Map();
    document.getElementById("settings-search").addEventListener("input", () => this.filter());
  }

  show(preset, config, set, problem) {
    const leaves = leavesOf(preset).filter(([key]) => !NOT_SET.has(key) && !NOT_SET.has(key.split(".")[0]));
    const shape = JSON.stringify([leaves.map(([key, value]) => [key, typeof value]), Boolean(this.schema)]);
    if (shape !== this.shape) this.build(leaves);
    this.shape = shape;
    this.set = set;
    const values = new Map(leavesOf(config || preset));
    for (const [key, value] of leaves) this.update(this.fields.get(key), key, value, values.get(key) ?? value, problem);
    this.filter();
  }

  update(field, key, preset, value, problem) {
    const isChanged = this.set.has(key);
    const isWrong = isChanged && Boolean(problem) && problem.includes(key.split(".").pop());
    field.preset = preset;
    field.box.classList.toggle("changed", isChanged);
    field.box.classList.toggle("wrong", isWrong);
    field.note.textContent = isWrong ? problem : "";
    if (document.activeElement === field.input && field.input.tagName === "INPUT" && field.input.type !== "checkbox") return;
    const now = isChanged ? this.set.get(key) : value;
    if (field.input.type === "checkbox") field.input.checked = String(now) === "true"; else field.input.value = String(now);
  }

  build(leaves) {
    this.fields.clear();
    const groups = new Map();
    for (const [key, value] of leaves) {
      const group = key.includes(".") ? key.split(".")[0] : "run";
      if (!groups.has(group)) groups.set(group, []);
      groups.get(group).push(this.field(key, value));
    }
    const tree = [...groups].map(([group, boxes]) => {
      const details = element("details");
      const inside = element("div", undefined, "settings-group");
      inside.append(...boxes);
      details.append(element("summary", group), inside);
      return details;
    });
    document.getElementById("settings-tree").replaceChildren(...tree);
  }

  field(key, value) {
    const about = aboutSetting(this.schema, key);
    const box = element("div", undefined, "setting");
    const label = element("label", key.split(".").slice(key.includes(".") ? 1 : 0).join(" › ").replace(/_/g, " "));
    const input = about.choices ? this.choices(about.choices) : element("input");
    if (!about.choices) input.type = typeof value === "boolean" ? "checkbox" : typeof value === "number" ? "number" : "text";
    if (input.type === "number") {
      typeOver(input);
      input.step = "any";
      if (about.low !== undefined) input.min = about.low;
      if (about.high !== undefined) input.max = about.high;
    }
    input.dataset.key = key;
    const note = element("p", "", "problem");
    const help = element("p", about.help, "setting-help");
    input.addEventListener("change", () => this.changeSet(set => {
      const now = input.type === "checkbox" ? String(input.checked) : input.value.trim();
      if (now === "" || now === String(this.fields.get(key).preset)) set.delete(key); else set.set(key, now);
    }));
    label.append(input);
    box.append(label, note, help);
    this.fields.set(key, { box, input, note, help: about.help.toLowerCase() });
    return box;
  }

  choices(names) {
    const select = element("select");
    select.append(...names.map(name => { const option = element("option", name); option.value = name; return option; }));
    return select;
  }

  // Only those whose name or help has every word that is searched for.
  filter() {
    const words = document.getElementById("settings-search").value.toLowerCase().split(/\s+/).filter(Boolean);
    let shown = 0;
    for (const [key, { box, help }] of this.fields) {
      const text = `${key.toLowerCase().replace(/_/g, " ")} ${help}`;
      box.hidden = !words.every(word => text.includes(word));
      shown += box.hidden ? 0 : 1;
    }
    for (const details of document.querySelectorAll("#settings-tree details")) {
      const any = [...details.querySelectorAll(".setting")].some(box => !box.hidden);
      details.hidden = !any;
      if (words.length) details.open = any;
    }
    const size = this.set?.size || 0;
    const changed = size ? `, ${count(size, "is", "are")} not as the preset has it` : "";
    document.getElementById("settings-count").textContent = `${count(shown, "setting", "settings")}${changed}`;
  }
}

// A number that is clicked is typed over, as one that is reached with the Tab key is.
function typeOver(input) {
  let isNew = false;
  input.addEventListener("pointerdown", () => { isNew = document.activeElement !== input; });
  input.addEventListener("click", () => { if (isNew) input.select(); });
}

// The numbers, switches and texts of a value, each with its way there; lists of plain things are one text.
function leavesOf(value, way = "") {
  if (value === null) return [];
  if (Array.isArray(value)) return value.every(item => typeof item !== "object") ? [[way, JSON.stringify(value)]] : [];
  if (typeof value !== "object") return [[way, value]];
  return Object.entries(value).flatMap(([name, inner]) => leavesOf(inner, way ? `${way}.${name}` : name));
}

// What the schema says of a setting: its help, and its range or what there is to choose from.
function aboutSetting(schema, key) {
  let place = schema;
  for (const name of key.split(".")) place = variants(schema, place).map(variant => variant.properties?.[name]).find(Boolean);
  const found = variants(schema, place);
  const first = name => found.map(variant => variant[name]).find(value => value !== undefined);
  const names = found.flatMap(variant => variant.enum || (variant.const !== undefined ? [variant.const] : []));
  const isNamed = names.length > 1 && names.every(name => typeof name === "string") && !found.some(variant => variant.properties);
  const low = first("minimum") ?? first("exclusiveMinimum");
  const high = first("maximum") ?? first("exclusiveMaximum");
  return { help: place?.description || first("description") || "", low, high, choices: isNamed ? names : null };
}

// A piece of a schema, and all that it may be instead.
function variants(schema, piece) {
  if (!piece) return [];
  const target = piece.$ref ? piece.$ref.split("/").slice(1).reduce((place, name) => place?.[name], schema) : null;
  const others = [target, ...(piece.anyOf || []), ...(piece.oneOf || []), ...(piece.allOf || [])];
  return [piece, ...others.filter(Boolean).flatMap(other => variants(schema, other))];
}
