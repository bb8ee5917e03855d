// The connection to a studio that is served: a web socket. When it breaks it is made anew.

class SocketConnection extends Connection {
  constructor(address) {
    super();
    this.address = address;
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
      if (typeof data === "string") this.tell(JSON.parse(data)); else this.takeFrame(data);
    });
    this.socket.addEventListener("close", () => {
      this.onState(false, "The studio does not answer. What was trained is saved. Begin the program again and open the address it shows.");
      setTimeout(() => this.connect(), this.wait);
      this.wait = Math.min(this.wait * 2, 5000);
    });
  }

  // What is asked for while there is no connection waits, but for what is only of this moment.
  ask(request) {
    const message = JSON.stringify(request);
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(message);
    else if (request.do !== "advance" && request.do !== "tell") this.waiting.push(message);
  }

  // A file of a run. Without `ok` its text is what is wrong.
  async get(address) {
    const answer = await fetch(address);
    const name = /filename="([^"]*)"/.exec(answer.headers.get("content-disposition"))?.[1];
    return { ok: answer.ok, name, blob: await answer.blob() };
  }

  // Lets a link lead to a file of a run.
  link(anchor, address) { anchor.href = address; }
}

function connect() {
  const address = new URL("socket", location.href);
  address.protocol = "ws:";
  address.hash = "";
  return new SocketConnection(address);
}
