// The connection to the studio: requests go out as JSON, events come in as JSON, frames as numbers. When it breaks it
// is made anew, and the run that was open is opened again.

class Connection {
  constructor(address) {
    this.address = address;
    this.listeners = new Map();
    this.onFrame = () => {};
    this.onState = () => {};
    this.wait = 250;
    this.waiting = [];
    this.connect();
  }

  connect() {
    this.socket = new WebSocket(this.address);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("open", () => {
      this.wait = 250;
      this.onState(true);
      for (const message of this.waiting.splice(0)) this.socket.send(message);
    });
    this.socket.addEventListener("message", ({ data }) => {
      if (typeof data === "string") this.tell(JSON.parse(data)); else this.onFrame(data);
    });
    this.socket.addEventListener("close", () => {
      this.onState(false);
      setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(this.wait * 2, 5000);
    });
  }

  on(kind, listener) {
    this.listeners.set(kind, [...this.listeners.get(kind) || [], listener]);
  }

  tell(event) {
    for (const listener of this.listeners.get(event.is) || []) listener(event);
  }

  // What is asked for while there is no connection waits, but for what is only of this moment.
  ask(request) {
    const message = JSON.stringify(request);
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(message);
    else if (request.do !== "advance" && request.do !== "tell") this.waiting.push(message);
  }
}
