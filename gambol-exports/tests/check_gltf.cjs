// Validates glTF files: node check_gltf.cjs FILE...
// Needs the package gltf-validator, where NODE_PATH or a folder node_modules has it. Fails if it finds anything.
const fs = require("fs");
const validator = require("gltf-validator");

async function check(path) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path)), { uri: path });
  const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
  for (const { code, message, pointer } of messages) console.log(`${code} at ${pointer}: ${message}`);
  console.log(`${numErrors} errors, ${numWarnings} warnings, ${numInfos} notes, ${numHints} hints`);
  return numErrors + numWarnings + numInfos + numHints;
}

Promise.all(process.argv.slice(2).map(check)).then((found) => {
  process.exit(found.some((count) => count > 0) ? 1 : 0);
});
