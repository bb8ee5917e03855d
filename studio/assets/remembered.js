// What this tab still has when it is loaded anew, by name: what is being drawn, and which run waits for its picture.

const remembered = {
  get(name) { try { return JSON.parse(sessionStorage.getItem(name)); } catch { return null; } },
  // A browser that keeps nothing remembers nothing either.
  set(name, value) { try { sessionStorage.setItem(name, JSON.stringify(value)); } catch { /* So it is. */ } },
};
