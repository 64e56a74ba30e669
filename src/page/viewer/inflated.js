// Reads what src/page/packed_text.h wrote: base64 of the deflate format. Browsers can, too, but not all
// of them, and not at once.
import { inflateSync, strFromU8 } from "fflate";

const bytesOf = (base64) => Uint8Array.from(atob(base64.trim()), (c) => c.charCodeAt(0));

// The text that was packed.
export const inflated = (base64) => strFromU8(inflateSync(bytesOf(base64)));
