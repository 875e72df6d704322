/** Views in space, loaded by pages that need them alone. */
export {};
