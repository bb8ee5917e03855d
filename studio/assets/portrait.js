// A creature in a small picture, in its start pose or, where there is a film of it, as it moves.

// `film`: gives `{ timeStep, poses }` once there is one. It is asked only while the picture can be seen.
function drawPortrait(canvas, creature, film = () => null) {
  const model = makeModel(creature);
  const stage = new Stage(canvas, 0.82);
  const start = new Float32Array(creature.parts.flatMap(({ position, angle }) => [position[0], position[1], (angle || 0) * Math.PI / 180]));
  const size = start.length;
  const current = () => (reducedMotion.matches && !canvas.closest("button")?.matches(":hover, :focus") ? null : film());
  const moment = ({ timeStep, poses }) => Math.floor(performance.now() / 1000 / timeStep) % (poses.length / size);
  // Portraits that were taken from the page are not drawn again.
  loop.views = loop.views.filter(view => !view.wasThere || view.canvas.isConnected);
  loop.addView({
    canvas,
    // It is drawn anew when its time is another.
    clock: { get time() { const shown = current(); return shown ? moment(shown) : -1; } },
    get visible() { this.wasThere ||= canvas.isConnected; return stage.visible && canvas.isConnected; },
    get stale() { return stage.stale; }, set stale(value) { stage.stale = value; },
    draw() {
      const shown = current();
      const at = shown ? moment(shown) * size : 0;
      const pose = shown ? shown.poses.subarray(at, at + size) : start;
      stage.scale = fittingScale(stage, model, model.height, 0.78, 6);
      stage.centreX = middleX(model, pose);
      stage.drawScenery(0, { plain: true, bare: true });
      drawShadow(stage, model, pose);
      drawCreature(stage, model, pose);
    },
  });
}

// The films of champions that a gallery shows, each asked for once.
class Films {
  constructor(connection) {
    this.connection = connection;
    this.films = new Map();
    connection.on("film", ({ run, time_step: timeStep, poses }) => {
      if (this.films.has(run)) this.films.get(run).film = poses.length ? { timeStep, poses: Float32Array.from(poses) } : null;
    });
  }

  // `fitness`: with another one it is another champion.
  of(run, fitness) {
    if (fitness === null) return null;
    const known = this.films.get(run);
    if (known?.fitness === fitness) return known.film;
    this.films.set(run, { fitness, film: known?.film ?? null });
    this.connection.ask({ do: "film", run });
    return known?.film ?? null;
  }
}
