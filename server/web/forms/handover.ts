/** Hands a file of any size from one page to the next one, within the browser. */
const open = (): Promise<IDBObjectStore> =>
  new Promise((resolve, reject) => {
    const request = indexedDB.open("bahnwerk", 1);
    request.onupgradeneeded = () => request.result.createObjectStore("files");
    request.onerror = () => reject(request.error);
    request.onsuccess = () => resolve(request.result.transaction("files", "readwrite").objectStore("files"));
  });

const result = <T>(request: IDBRequest<T>): Promise<T> =>
  new Promise((resolve, reject) => {
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });

/** Keeps a file until takeFile(); a later one replaces it. */
export async function keepFile(file: File): Promise<void> {
  await result((await open()).put({ name: file.name, data: file }, "file"));
}

/** Returns the kept file, once; undefined where there is none. */
export async function takeFile(): Promise<{ name: string; data: Blob } | undefined> {
  const store = await open();
  const kept = (await result(store.get("file"))) as { name: string; data: Blob } | undefined;
  if (kept) await result(store.delete("file"));
  return kept;
}
