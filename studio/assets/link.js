// A champion in an address: its file, compressed, in the part of the address that is never sent to a server.

const LINKED = "#champion=";

const through = async (bytes, stream) => new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());

// Digits that an address may have in it: base64url.
function digitsOf(bytes) {
  let text = "";
  for (let at = 0; at < bytes.length; at += 4096) text += String.fromCharCode(...bytes.subarray(at, at + 4096));
  return btoa(text).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

const bytesOf = digits => Uint8Array.from(atob(digits.replaceAll("-", "+").replaceAll("_", "/")), sign => sign.charCodeAt(0));

async function linkTo(text) {
  // Without the spaces that make it readable. A number is not touched: it would be another file.
  const plain = text.replace(/("(?:[^"\\]|\\.)*")|\s+/g, "$1");
  const bytes = await through(new TextEncoder().encode(plain), new CompressionStream("deflate-raw"));
  return `${location.origin}${location.pathname}${LINKED}${digitsOf(bytes)}`;
}

// The champion's file in an address; `null` if there is none.
async function linkedIn(hash) {
  if (!hash.startsWith(LINKED)) return null;
  const bytes = await through(bytesOf(hash.slice(LINKED.length)), new DecompressionStream("deflate-raw"));
  return new TextDecoder().decode(bytes);
}
