// The connection to the studio, wherever that is: requests go out and events come in as JSON, frames come as numbers. Each
// home of the studio has a connection of its own, which `connect` makes.

class Connection {
  constructor() {
    this.listeners = new Map();
    this.frameListeners = [];
    this.onState = () => {};
  }

  on(kind, listener) {
    this.listeners.set(kind, [...this.listeners.get(kind) || [], listener]);
  }

  onFrame(listener) { this.frameListeners.push(listener); }

  takeFrame(buffer) {
    for (const listener of this.frameListeners) listener(buffer);
  }

  tell(event) {
    for (const listener of this.listeners.get(event.is) || []) listener(event);
  }
}

function saveAs(blob, name) {
  const link = element("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
