/** Two jobs side by side. */
import { byId } from "./base/dom";
import { startPage } from "./base/page";
import { working } from "./base/work";
import { mountCompare } from "./compare/mount";

startPage();
const section = byId("compare");
if (section) void working(mountCompare(section));
