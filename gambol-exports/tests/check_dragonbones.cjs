// Plays a skeleton in the runtime of DragonBones: node check_dragonbones.cjs NAME_ske.json NAME_tex.json
// Writes for each frame of its animation, as JSON, where the middle of each picture is (px, y down), how it is turned (rad,
// clockwise) and what it shows. Needs the package @cocos/dragonbones-js, where NODE_PATH or a folder node_modules has it.
const fs = require("fs");
const { pathToFileURL } = require("url");

async function main([skeleton, atlas]) {
  // It greets when it is loaded.
  console.info = () => {};
  const db = await import(pathToFileURL(require.resolve("@cocos/dragonbones-js")).href);

  // What an engine brings along: here nothing is drawn.
  class Texture extends db.TextureData {
    static toString() { return "[class Texture]"; }
  }
  class Atlas extends db.TextureAtlasData {
    static toString() { return "[class Atlas]"; }
    createTexture() { return db.BaseObject.borrowObject(Texture); }
  }
  class Slot extends db.Slot {
    static toString() { return "[class Slot]"; }
  }
  const nothing = ["_initDisplay", "_disposeDisplay", "_onUpdateDisplay", "_addDisplay", "_replaceDisplay", "_removeDisplay",
    "_updateZOrder", "_updateVisible", "_updateBlendMode", "_updateColor", "_updateFrame", "_updateMesh", "_updateGlueMesh",
    "_updateTransform", "_identityTransform"];
  for (const name of nothing) Slot.prototype[name] = () => {};
  const proxy = {
    dbInit() {}, dbClear() {}, dbUpdate() {}, dispose() {}, hasDBEventListener: () => false, dispatchDBEvent() {},
    addDBEventListener() {}, removeDBEventListener() {},
  };
  class Factory extends db.BaseFactory {
    _buildTextureAtlasData(data) { return data ?? db.BaseObject.borrowObject(Atlas); }
    _buildArmature() {
      const armature = db.BaseObject.borrowObject(db.Armature);
      armature.init(this.skeleton, proxy, {}, this._dragonBones);
      return armature;
    }
    _buildSlot(_, data, armature) {
      const slot = db.BaseObject.borrowObject(Slot);
      slot.init(data, armature, {}, {});
      return slot;
    }
  }

  const read = (path) => JSON.parse(fs.readFileSync(path));
  const factory = new Factory();
  db.DragonBones.yDown = true;
  factory._dragonBones = new db.DragonBones(proxy);
  const data = factory.parseDragonBonesData(read(skeleton));
  factory.parseTextureAtlasData(read(atlas), {});
  factory.skeleton = data.getArmature(data.armatureNames[0]);
  const armature = factory.buildArmature(factory.skeleton.name);
  const animation = factory.skeleton.defaultAnimation;
  const frames = [];
  for (let frame = 0; frame < animation.frameCount; frame++) {
    armature.animation.gotoAndStopByFrame(animation.name, frame);
    armature.advanceTime(0);
    const shown = {};
    for (const slot of armature.getSlots()) {
      if (slot._textureData === null) continue;
      slot.updateGlobalTransform();
      const { a, b, tx, ty } = slot.globalTransformMatrix;
      const { width, height } = slot._textureData.region;
      // A picture turns around its pivot, which is its middle unless the file says otherwise.
      const [right, down] = [0.5 * width - slot._pivotX, 0.5 * height - slot._pivotY];
      shown[slot.name] = { x: tx + a * right - b * down, y: ty + b * right + a * down, angle: Math.atan2(b, a), texture: slot._textureData.name };
    }
    frames.push(shown);
  }
  process.stdout.write(JSON.stringify(frames));
}

main(process.argv.slice(2)).catch((error) => {
  console.error(error);
  process.exit(1);
});
