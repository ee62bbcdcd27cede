// Turns back what report/page/packed_array.cpp wrote: base64, inflate, four byte planes, differences.

async function inflated(text) {
  const packed = Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

export async function unpackText(text) {
  return new TextDecoder().decode(await inflated(text));
}

export async function unpack(text, count, stride) {
  const planes = await inflated(text);
  const values = new Uint32Array(count);
  for (let k = 0; k < count; ++k) {
    const difference = planes[k] | planes[k + count] << 8 | planes[k + 2 * count] << 16 |
        planes[k + 3 * count] << 24;
    values[k] = difference + (k >= stride ? values[k - stride] : 0);  // modulo 2^32 by the array
  }
  return values;
}
