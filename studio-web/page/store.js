// What keeps a disk between visits: a database of the browser, with a record for each file and each folder.

class Store {
  static async open(name) {
    const request = indexedDB.open(name, 1);
    request.onupgradeneeded = () => request.result.createObjectStore("disk", { keyPath: "path" });
    return new Store(await Store.result(request));
  }

  static result(request) {
    return new Promise((resolve, reject) => {
      request.onsuccess = () => resolve(request.result);
      request.onerror = () => reject(request.error);
    });
  }

  constructor(database) {
    this.database = database;
    this.last = Promise.resolve();
    // Whoever wants to delete the database does not have to wait for this page.
    database.onversionchange = () => database.close();
  }

  // Puts all that is kept into the disk.
  load(disk) {
    return this.next(async () => {
      const records = await Store.result(this.database.transaction("disk").objectStore("disk").getAll());
      for (const { path, bytes, changed } of records) {
        // Two pages that keep their disks here can leave a file where the other has a folder. The rest is still of use.
        try { disk.restore(path, bytes, changed); } catch (error) { console.warn(error); }
      }
    });
  }

  // Keeps what has changed of the disk. What cannot be kept now is tried again with what has changed by the next time.
  save(disk) {
    return this.next(async () => {
      const changes = disk.takeChanges();
      const { written, removed, folders } = changes;
      if (written.length + removed.length + folders.length === 0) return;
      try {
        await this.change(records => {
          for (const path of removed) records.delete(path);
          for (const path of folders) records.put({ path });
          for (const [path, bytes, changed] of written) records.put({ path, bytes, changed });
        });
      } catch (error) {
        disk.putBack(changes);
        throw error;
      }
    });
  }

  clear() {
    return this.next(() => this.change(records => { records.clear(); }));
  }

  // One transaction, all of it or nothing: what is kept is the disk of one moment.
  change(make) {
    return new Promise((resolve, reject) => {
      const transaction = this.database.transaction("disk", "readwrite", { durability: "relaxed" });
      transaction.oncomplete = () => resolve();
      transaction.onabort = () => reject(transaction.error);
      try {
        make(transaction.objectStore("disk"));
      } catch (error) {
        reject(error);
        transaction.abort();
      }
    });
  }

  // One after the other, also after one that failed.
  next(task) {
    const turn = this.last.then(task);
    this.last = turn.catch(() => {});
    return turn;
  }
}
