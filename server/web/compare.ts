/** Two jobs side by side. */
import { byId } from "./base/dom";
import { startPage } from "./base/page";
import { mountCompare } from "./compare/mount";

startPage();
const section = byId("compare");
if (section) void mountCompare(section);
