// The fields of the creature editor: what can be set of a creature, a part and a joint, and how.

// Sensors: name, what they tell, and their settings when they are new.
const EDITOR_SENSORS = [
  ["torso-rotation", "how far the torso leans"], ["joint-angles", "how far each joint is bent"],
  ["joint-speeds", "how fast each joint turns"], ["torso-velocity", "how fast the torso moves, forward and up"],
  ["torso-spin", "how fast the torso tumbles"], ["torso-height", "how far the torso is above its start height"],
  ["height-above-ground", "how far the torso is above what is below it"], ["foot-contacts", "which feet touch the ground"],
  ["foot-slip", "how fast each foot slides"], ["rangefinder", "how far away things ahead are", { angles: [-30], length: 3 }],
  ["next-gap", "how far the next gap is, and how wide", { length: 4 }], ["clock", "a steady beat", { period: 1 }],
  ["landing-clock", "a beat that begins anew at each landing", { period: 1 }],
  ["commanded-speed", "how fast it is told to go", { top: 3 }],
  ["stride-clock", "a beat, the stronger the faster it is told to go", { period: 0.5, top: 3 }],
  ["jump-command", "whether it is told to jump"], ["jump-clock", "one turn of a clock from the jump on", { period: 0.5 }],
  ["custom", "what a program of your own has it sense", { name: "my-sensor" }],
];
const EDITOR_MOST_SENSORS = 64;
const EDITOR_MOST_RAYS = 64;
const EDITOR_SETTINGS = { period: "Time of one turn", length: "Reach", top: "Top speed" };

// The fields of what is selected. A field says how it gets its value from a creature and sets it in one.
function editorFields(creature, selection) {
  if (!selection) return creatureFields(creature);
  if (selection.kind === "joint") return jointFields(creature, selection.index);
  if (decorationsOf(creature.parts[selection.index])[selection.decoration]) return decorationFields(creature, selection);
  const joint = hangingTree(creature).joint[selection.index];
  const list = [{ key: "painted", kind: "heading", label: "Decorations" }, { key: "decorations", kind: "decorations" }];
  return [...partFields(creature, selection.index), ...(joint === -1 ? [] : jointFields(creature, joint)), ...list];
}

function numberField(key, label, bounds, get, set, step = 0.01, help = `${bounds[0]} to ${bounds[1]}`) {
  return { key, kind: "number", label, bounds, get, set, step, help: help.replace("-", "−") };
}

function creatureFields(creature) {
  const text = (key, label, kind, help) => ({
    key, label, kind, help, get: c => c[key] ?? "",
    set: (c, value) => { if (value || key === "name") c[key] = value; else delete c[key]; },
  });
  const flag = (key, label, help) => ({
    key, kind: "check", label, help, get: c => Boolean(c[key]), set: (c, on) => { c[key] = on; },
  });
  const { parts } = creature;
  const mass = parts.reduce((sum, part) => sum + part.density * shapeArea(part.shape), 0);
  return [
    { key: "creature", kind: "heading", label: "Creature" },
    text("name", "Name", "text", "of files and folders: letters, digits, spaces, - _ ."),
    text("title", "Title", "text", "what people call it"), text("description", "Description", "long"),
    { key: "facts", kind: "note", label: `${count(parts.length, "part", "parts")}, ${tidy(mass)} kg. Click one to change it.` },
    flag("self_collision", "Parts bump into each other", "otherwise they pass through"),
    flag("symmetric", "Same from both sides", "then it can run both ways"),
    { key: "tags", kind: "heading", label: "What the controller moves" },
    ...tagFields(creature),
    { key: "sensors", kind: "heading", label: "What it senses" },
    ...sensorFields(creature),
  ];
}

// Kinds of parts, in the order of the parts; then those that are to be moved and of which there is no part.
function tagFields(creature) {
  const tags = new Set([...creature.parts.slice(1).map(part => part.tag), ...drivenTags(creature)]);
  return [...tags].map(tag => {
    const names = creature.parts.filter(part => part.tag === tag).map(part => part.name);
    const few = names.length > 4 ? [...names.slice(0, 3), `${names.length - 3} more`] : names;
    return {
      key: `tags.${tag}`, kind: "check", label: `Parts of the kind “${tag}”`,
      help: few.join(", ") || "no part is of this kind",
      get: c => drivenTags(c).includes(tag),
      set: (c, on) => {
        const rest = drivenTags(c).filter(other => other !== tag);
        c.actuated_tags = on ? [...rest, tag] : rest;
      },
    };
  });
}

function sensorName(sensor) { return typeof sensor === "string" ? sensor : Object.keys(sensor || {})[0] ?? "unknown"; }

function sensorsOf(creature) { return creature.sensors || ["torso-rotation", "joint-angles"]; }
function sensorsNamed(creature, name) { return sensorsOf(creature).filter(sensor => sensorName(sensor) === name); }

function sensorFields(creature) {
  const known = new Set(EDITOR_SENSORS.map(([name]) => name));
  const others = [...new Set(sensorsOf(creature).map(sensorName))].filter(name => !known.has(name));
  return [...EDITOR_SENSORS, ...others.map(name => [name, "of another program"])].flatMap(([name, help, settings]) => {
    const words = (name[0]?.toUpperCase() ?? "") + name.slice(1).replace(/-/g, " ");
    return [{
      key: `sensors.${name}`, kind: "check", label: words, help, get: c => sensorsNamed(c, name).length > 0,
      set: (c, on) => {
        const rest = sensorsOf(c).filter(sensor => sensorName(sensor) !== name);
        c.sensors = on ? [...rest, settings ? { [name]: structuredClone(settings) } : name] : rest;
      },
    }, ...(settings ? kindFields(creature, name, words, settings) : [])];
  });
}

// The settings of all sensors of a kind: there may be two clocks.
function kindFields(creature, name, words, settings) {
  const found = sensorsNamed(creature, name);
  const action = (key, label, change) => ({ key: `${name}.${key}`, kind: "action", label, press: editor => editor.edit(change) });
  const fields = found.flatMap((sensor, nth) => {
    const own = sensor[name] ? settingFields(`${name}.${nth}`, settings, c => sensorsNamed(c, name)[nth][name]) : [];
    if (found.length === 1) return own;
    const remove = action(`${nth}.remove`, `Remove ${words}, ${nth + 1}`, c => {
      const gone = sensorsNamed(c, name)[nth];
      c.sensors = c.sensors.filter(other => other !== gone);
    });
    return [...own.map(field => ({ ...field, label: `${field.label}, ${nth + 1}` })), remove];
  });
  if (!found.length || sensorsOf(creature).length >= EDITOR_MOST_SENSORS) return fields;
  return [...fields, action("more", `One more ${words}`, c => {
    c.sensors.push(otherSensor(sensorsNamed(c, name).at(-1), name, settings));
  })];
}

// A sensor that tells something else than one of the same kind: two that tell the same are a problem.
function otherSensor(sensor, name, settings) {
  const made = { ...settings, ...structuredClone(sensor[name]) };
  const [first] = Object.keys(settings);
  if (first === "angles") made.angles = [made.angles].flat().map(angle => editorBounded(angle - 10, EDITOR_BOUNDS.limit, 0));
  else if (first === "name") made.name = `${made.name} 2`;
  else made[first] = editorRounded(editorBounded(made[first] * 1.5, EDITOR_BOUNDS[first], settings[first]), 2);
  return { [name]: made };
}

function settingFields(sensor, settings, of) {
  return Object.keys(settings).flatMap(name => {
    const key = `${sensor}.${name}`;
    if (name === "angles") return [raysField(key, of)];
    if (name === "name") return customFields(sensor, of);
    const set = (c, value) => { of(c)[name] = value; };
    return [numberField(key, EDITOR_SETTINGS[name], EDITOR_BOUNDS[name], c => of(c)[name], set, 0.1)];
  });
}

// A sensor of another program has settings that only that program knows.
function customFields(sensor, of) {
  const read = text => { try { return JSON.parse(text || "{}"); } catch { return null; } };
  return [{
    key: `${sensor}.name`, kind: "text", label: "Name", help: "under which the program knows it", get: c => of(c).name ?? "",
    set: (c, value) => { of(c).name = value || of(c).name; },
  }, {
    key: `${sensor}.settings`, kind: "long", label: "Settings", help: "what it is told, as JSON: {\"most\": 0.5}",
    get: c => of(c).settings ? JSON.stringify(of(c).settings) : "",
    problem: value => typeof read(value) === "object" && read(value) && !Array.isArray(read(value)) ? "" : "No JSON object.",
    set: (c, value) => {
      const settings = read(value);
      if (Object.keys(settings).length) of(c).settings = settings;
      else delete of(c).settings;
    },
  }];
}

function raysField(key, of) {
  return {
    key, kind: "text", label: "Rays", help: "degrees, 0 is ahead, negative down: -30, 0",
    get: c => [of(c).angles].flat().join(", "),
    set: (c, value) => {
      const angles = value.split(/[,;\s]+/).filter(Boolean).map(Number).filter(Number.isFinite).slice(0, EDITOR_MOST_RAYS);
      if (angles.length) of(c).angles = angles.map(angle => editorBounded(angle, EDITOR_BOUNDS.limit, 0));
    },
  };
}

function partFields(creature, index) {
  const of = c => c.parts[index];
  const part = of(creature);
  const driven = drivenTags(creature).join("”, “");
  const isLoose = index > 0 && hangingTree(creature).joint[index] === -1;
  const number = (key, label, otherwise, step, help) => numberField(key, label, EDITOR_BOUNDS[key], c => of(c)[key] ?? otherwise,
    (c, value) => { of(c)[key] = value; }, step, help);
  const position = (axis, label) => numberField(`position[${axis}]`, label, EDITOR_BOUNDS.position, c => of(c).position[axis],
    (c, value) => moveSubtree(c, index, [0, 1].map(i => i === axis ? value - of(c).position[i] : 0)));
  return [
    { key: "part", kind: "heading", label: part.name },
    { key: "name", kind: "text", label: "Name", get: c => of(c).name, set: (c, value) => renamePart(c, index, value) },
    {
      key: "tag", kind: "text", label: "Kind",
      help: driven ? `parts of the kind “${driven}” are moved by the controller` : "the controller moves no kind of part",
      get: c => of(c).tag, set: (c, value) => { of(c).tag = value.slice(0, EDITOR_LONGEST_NAME) || of(c).tag; },
    },
    ...(isLoose ? [parentField(creature, index)] : []),
    ...shapeFields(part, index),
    ...lookFields(part, index),
    number("density", "Density", 30, 1),
    number("friction", "Friction", 1, 0.1, "0 (ice) to 10"),
    position(0, "Forward"), position(1, "Up"),
    numberField("angle", "Turned", EDITOR_BOUNDS.angle, c => of(c).angle ?? 0,
      (c, value) => turnSubtree(c, index, value - (of(c).angle ?? 0)), 5),
    ...(index ? [{
      key: "leg", kind: "check", label: "May be a leg", help: "not for arms and tails", get: c => of(c).leg !== false,
      set: (c, on) => { if (on) delete of(c).leg; else of(c).leg = false; },
    }] : []),
    { key: "mass", kind: "note", label: `It weighs ${tidy(part.density * shapeArea(part.shape))} kg.` },
  ];
}

// The part that a part hangs on: any that does not hang on it.
function parentField(creature, index) {
  const tree = hangingTree(creature);
  const own = subtreeOf(tree, index);
  const options = Object.fromEntries(creature.parts.map(({ name }, i) => [i, name]).filter(([i]) => !own.includes(i)));
  if (tree.parent[index] < 0) options[-1] = "nothing yet";
  return {
    key: "parent", kind: "choice", label: "Hangs on", options,
    get: c => hangingTree(c).parent[index], set: (c, value) => { if (value !== "-1") hangOn(c, index, Number(value)); },
  };
}

function shapeFields(part, index) {
  const of = c => c.parts[index].shape;
  const kind = shapeKind(part.shape);
  const names = { width: "Width", height: "Height", radius: "Radius", length: "Straight length" };
  const sizes = Object.keys(part.shape[kind]).map(name => numberField(`shape.${kind}.${name}`, names[name], EDITOR_BOUNDS.size,
    c => of(c)[kind]?.[name], (c, value) => reshapePart(c, index, { [kind]: { ...of(c)[kind], [name]: value } })));
  return [{
    key: "shape", kind: "choice", label: "Shape", options: { box: "Box", capsule: "Capsule", circle: "Circle" },
    get: c => shapeKind(of(c)),
    set: (c, value) => {
      const { box } = of(c);
      if (value === "capsule" && box?.width > box?.height) standOnEnd(c.parts[index]);
      reshapePart(c, index, shapeOfKind(value, halfExtent(of(c))));
    },
  }, ...sizes];
}

function lookFields(part, index) {
  const get = (key, otherwise) => c => c.parts[index].look?.[key] ?? otherwise;
  const set = key => (c, value) => { (c.parts[index].look ||= {})[key] = value; };
  const number = (key, label, ...rest) => numberField(`look.${key}`, label, EDITOR_BOUNDS[key], get(key, 0), ...rest);
  return [
    ...(part.shape.box ? [number("corner_radius", "Corner radius", set("corner_radius"))] : []),
    { key: "look.colour", kind: "colour", label: "Colour", get: get("colour", PLAIN_COLOUR), set: set("colour") },
    number("layer", "Layer", (c, value) => set("layer")(c, Math.round(value)), 1, "-100 back to 100 front"),
    numberField("look.opacity", "Opacity", EDITOR_BOUNDS.opacity, get("opacity", 1), set("opacity"), 0.05, "0 (invisible) to 1"),
  ];
}

function jointFields(creature, index) {
  const of = c => c.joints[index];
  const joint = of(creature);
  const child = hangingTree(creature).joint.indexOf(index);
  const motor = (name, label) => numberField(`motor.${name}`, label, EDITOR_BOUNDS[name], c => of(c).motor?.[name],
    (c, value) => { of(c).motor[name] = value; }, 1);
  const limit = (which, label, bounds) => numberField(`limits[${which}]`, label, bounds, c => of(c).limits[which],
    (c, value) => setLimit(of(c), which, value), 5);
  const anchor = (axis, label) => numberField(`anchor[${axis}]`, label, EDITOR_BOUNDS.position, c => of(c).anchor[axis],
    (c, value) => { of(c).anchor[axis] = value; });
  return [
    { key: "joint", kind: "heading", label: `Hinge: ${joint.child} on ${joint.parent}` },
    ...(child > 0 ? [parentField(creature, child)] : []),
    {
      key: "drive", kind: "choice", label: "Moved by",
      options: { driven: "the controller", held: "nothing: a motor holds it", limp: "nothing: it is limp" },
      get: c => jointDrive(c, of(c)), set: (c, value) => setJointDrive(c, of(c), value),
    },
    limit(0, "Limit clockwise", [-180, 0, "°"]), limit(1, "Limit anticlockwise", [0, 180, "°"]),
    ...(joint.motor ? [motor("top_torque", "Top torque"), motor("top_speed", "Top speed")] : []),
    anchor(0, "Hinge forward"), anchor(1, "Hinge up"),
  ];
}

function jointDrive(creature, joint) {
  if (!joint.motor) return "limp";
  const child = creature.parts.find(part => part.name === joint.child);
  return child && drivenTags(creature).includes(child.tag) ? "driven" : "held";
}

// Which joints the controller moves is a matter of the child's tag, whether anything does one of the motor.
function setJointDrive(creature, joint, drive) {
  const child = creature.parts.find(part => part.name === joint.child);
  if (!child) return;
  if (drive === "limp") delete joint.motor;
  else joint.motor ||= fittingMotor(creature, Math.hypot(...halfExtent(child.shape)) * 2);
  if (drive === "driven" && jointDrive(creature, joint) !== "driven") {
    if (!drivenTags(creature).length) creature.actuated_tags = ["leg"];
    child.tag = drivenTags(creature)[0];
  }
  if (drive === "held" && jointDrive(creature, joint) !== "held") {
    child.tag = "held";
    for (let number = 2; drivenTags(creature).includes(child.tag); number++) child.tag = `held ${number}`;
  }
  if (drive !== "limp") joint.limits.forEach((limit, which) => setLimit(joint, which, limit));
}
