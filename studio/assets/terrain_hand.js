// The pointers on the canvas of the terrain editor: what one that goes down is about to do. Pointers, pinches and looking
// around are those of the creature editor.
class TerrainHand extends EditorHand {
  constructor(editor, canvas) {
    super(editor, canvas);
    // Scrolling sideways looks around; up and down it zooms.
    canvas.stage.canvas.addEventListener("wheel", event => {
      const step = event.shiftKey && !event.deltaX ? event.deltaY : event.deltaX;
      if (event.ctrlKey || Math.abs(step) < Math.abs(event.deltaY)) return;
      event.preventDefault();
      event.stopImmediatePropagation();
      canvas.pan(step * (event.deltaMode ? 30 : 1) / canvas.stage.width, 0);
    }, { capture: true, passive: false });
    canvas.stage.canvas.addEventListener("pointerleave", () => canvas.hover(null, -1));
  }

  begin(pixel, { button, pointerType, altKey, shiftKey }) {
    const { editor, canvas } = this;
    const world = canvas.world(pixel);
    const reach = pointerType === "touch" ? 22 : 9;
    if (button === 1 || this.isPanning) return { move: this.panning(pixel) };
    const handle = canvas.handleAt(pixel, reach);
    if (handle) return { move: this.pulling(handle) };
    const found = canvas.obstacleAt(pixel, reach / 2);
    if (editor.tool !== "select") return { click: () => editor.select(found), move: this.drawing(world, altKey) };
    if (found < 0) return { click: () => editor.select(-1), move: this.panning(pixel) };
    editor.select(found);
    return { click: () => editor.tell(), move: this.moving(found, world[0], shiftKey) };
  }

  // A second click is one more click.
  twice() {}

  move(event) {
    super.move(event);
    const { editor, canvas } = this;
    if (this.pointers.size || event.pointerType === "touch") return;
    const pixel = canvas.pixel(event);
    const handle = canvas.handleAt(pixel, 9);
    const found = canvas.obstacleAt(pixel, 4.5);
    const isTool = editor.tool !== "select";
    canvas.stage.canvas.dataset.over = handle ? handle.kind : !isTool && found >= 0 ? "obstacle" : "";
    canvas.hover(this.snapped(canvas.world(pixel)[0], event.altKey), found);
  }

  snapped(value, isFree) {
    return isFree ? editorRounded(value, 3) : Math.round(value / TERRAIN_SNAP) * TERRAIN_SNAP;
  }

  // Moves one, or it and all behind it.
  moving(index, start, isWithAll) {
    const { from } = obstacleSizes(this.present.drawn[index]);
    const move = isWithAll ? shiftObstacles : placeObstacle;
    return ([x], isFree) => {
      this.editor.preview(({ drawn }) => move(drawn, index, this.snapped(from + x - start, isFree)));
      this.editor.tell();
    };
  }

  // Drags a handle of what is selected.
  pulling({ kind, offset }) {
    const { editor } = this;
    const { selected } = editor;
    const level = terrainLevels(this.present.drawn)[selected];
    return ([x, y], isFree) => {
      editor.preview(({ drawn }) => {
        const place = this.snapped(x - offset[0], isFree);
        if (kind !== "top") pullObstacle(drawn, selected, kind !== "start", place);
        if (kind === "top" || kind === "end-top") raiseObstacle(drawn[selected], this.snapped(y - offset[1] - level, isFree));
      });
      editor.tell();
    };
  }

  // Draws an obstacle from where the pointer went down.
  drawing([startX], isFreeStart) {
    const { editor } = this;
    const { tool } = editor;
    const from = this.snapped(Math.max(startX, 0), isFreeStart);
    return ([x, y], isFree) => {
      let added = -1;
      editor.preview(({ drawn }) => {
        const { index } = roomAt(drawn, from, x - from);
        const height = y - terrainLevels(drawn)[index];
        if (Math.max(startX, x) <= 0) return;
        // Of a box there is something to be seen from the first.
        const tall = tool === "box" ? Math.max(height, TERRAIN_SNAP) : height;
        added = addObstacle(drawn, tool, from, this.snapped(x, isFree), this.snapped(tall, isFree));
        if (added >= 0) editor.selected = added;
      });
      if (added >= 0) editor.tell();
      else editor.sayFull();
    };
  }
}
