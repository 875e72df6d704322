// Chromium of the system, by playwright-core.
import { existsSync } from 'node:fs';
import { chromium } from 'playwright-core';

/** Sizes that pages are made for. */
export const sizes = {
  desk: { viewport: { width: 1280, height: 800 } },
  phone: { viewport: { width: 390, height: 844 }, deviceScaleFactor: 2, isMobile: true, hasTouch: true },
};

const executablePath = process.env.CHROMIUM ?? '/usr/bin/chromium';

/** Starts the browser. Space is drawn by software, so that pictures are the same on machines with and without a graphics card; the network ends at this
 *  machine. The sandbox does not run as root. */
export async function launch() {
  if (!existsSync(executablePath)) throw new Error(`There is no ${executablePath}. Install Debian's package chromium, or set CHROMIUM to the path of one.`);
  const args = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-gpu-compositing', '--disable-dev-shm-usage', '--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1'];
  return chromium.launch({ executablePath, args, chromiumSandbox: process.getuid() !== 0 });
}

/** Returns the settings of a context: size `desk` or `phone`, scheme `light` or `dark`, lang `en` or `de`. */
export function settings({ size = 'desk', scheme = 'light', lang = 'en' } = {}) {
  return { ...sizes[size], colorScheme: scheme, locale: { en: 'en-GB', de: 'de-DE' }[lang], timezoneId: 'Europe/Berlin' };
}
