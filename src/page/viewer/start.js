// Begins the page: its program stands in it packed, a third as long.
import { inflated } from "./inflated.js";

const program = document.createElement("script");
program.textContent = inflated(document.getElementById("program").textContent);
document.body.append(program);
