// Texts that stand packed in the page, by what start.js began it with.
export const { bytesOf, inflatedBytes, textOf } = globalThis.ambulo;

// The text that was packed.
export const inflated = (base64) => textOf(inflatedBytes(bytesOf(base64)));
