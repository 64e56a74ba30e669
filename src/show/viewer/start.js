// Begins the page: its program stands in it packed, a third as long.
import { bytesOf, inflatedBytes, textOf } from "./packing.js";

globalThis.ambulo = { bytesOf, inflatedBytes, textOf };
const program = document.createElement("script");
program.textContent = textOf(inflatedBytes(bytesOf(document.getElementById("program").textContent)));
document.body.append(program);
