// Begins the page: its program stands in it packed, a third as long.
import { inflate } from "./inflate.js";

const program = document.createElement("script");
program.textContent = inflate(document.getElementById("program").textContent);
document.body.append(program);
