// Reads what src/show/packed_text.h wrote: base64 of the deflate format. Browsers can, too, but not all
// of them, and not at once. It stands once in the page, in what begins it (start.js), and is handed on
// to the program that it unpacks (inflated.js).
import { inflateSync, strFromU8 } from "fflate";

export const bytesOf = (base64) => Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));
export { inflateSync as inflatedBytes, strFromU8 as textOf };
