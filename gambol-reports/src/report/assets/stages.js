// The stages of a run: a film of each stage's champion, and what is worth knowing of it.

function buildStages(run, model) {
  const stages = run.stages || [];
  if (!stages.length) return;
  document.getElementById("stages").hidden = false;
  const list = document.getElementById("stages-list");
  const clock = loop.addClock(new Clock(0));
  const tiles = [];
  for (const stage of stages) {
    const item = document.createElement("li");
    const replay = decodeReplay(stage.film, decodeGround(stage.ground));
    if (replay) {
      const body = stage.creature ? makeModel(stage.creature) : model;
      const tile = new FilmTile(replay, body, clock, highestCentre(replay), `The champion of the stage ${stage.name}`, 0.55);
      item.append(tile.frame);
      tiles.push(tile);
    }
    item.append(element("h3", `${stage.number}. ${stage.name}`));
    const facts = element("dl", undefined, "terms");
    const generations = stage.last_generation >= stage.first_generation
      ? `${fixed(stage.first_generation, 0)} to ${fixed(stage.last_generation, 0)}` : "none";
    const pairs = [["Generations", generations]];
    if (stage.fitness !== null && stage.fitness !== undefined) pairs.push(["Champion", withUnit(stage.fitness, stage.unit)]);
    terms(facts, [...pairs, ...(stage.facts || []).map(({ label, value }) => [label, value])]);
    item.append(facts);
    list.append(item);
  }
  clock.setDuration(Math.max(0, ...tiles.map(tile => tile.replay.duration)));
  for (const tile of tiles) tile.mount();
  playButton(document.getElementById("stages-play"), clock);
  clock.playing = !reducedMotion.matches;
  if (reducedMotion.matches) clock.seek(clock.duration * 0.5);
}
