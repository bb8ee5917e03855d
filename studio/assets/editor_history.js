// What is drawn in an editor, its history, what is wrong with it, and which keys are the editor's. An editor says what it has
// selected (`mark`), what of it is checked (`toCheck`), what is put straight after a change (`tidy`), who hears of changes and
// problems (`changed`, `found`), and what keys do (`act`, `escape`, `plainKey`).

const EDITOR_CHECK_DELAY = 150;

class EditorHistory {
  constructor(root, hooks) {
    Object.assign(this, { root, hooks, problems: [], checks: 0 });
    this.forgetPast();
  }

  forgetPast() { Object.assign(this, { past: [], future: [], base: null }); }

  // Changes what is drawn: `change` is given a copy, and may select something in it.
  edit(change) {
    this.preview(change);
    this.commit();
  }

  // Shows a change of what was drawn before the first preview; `commit` keeps it, `cancel` drops it.
  preview(change) {
    this.base ||= this.entry();
    const next = JSON.parse(this.base.json);
    this.mark = this.base.mark;
    change(next);
    this.present = next;
    this.refresh();
  }

  entry() { return { json: JSON.stringify(this.present), mark: this.mark }; }

  restore({ json, mark }) {
    Object.assign(this, { present: JSON.parse(json), mark, base: null });
    this.refresh();
  }

  cancel() {
    if (this.base) this.restore(this.base);
  }

  commit() {
    const { base } = this;
    if (!base) return;
    this.base = null;
    this.tidy();
    if (JSON.stringify(this.present) !== base.json) {
      this.past.push(base);
      this.future = [];
      this.changed();
    }
    this.refresh();
  }

  tidy() {}

  // Goes a step through the history, from one pile to the other.
  step(from, to) {
    this.cancel();
    const entry = from.pop();
    if (!entry) return;
    to.push(this.entry());
    this.restore(entry);
    this.changed();
  }

  // Asks for the problems once it has been left alone for a moment; an answer that is overtaken is dropped.
  checkSoon() {
    const turn = ++this.checks;
    clearTimeout(this.timer);
    this.timer = setTimeout(async () => {
      const checked = structuredClone(this.toCheck);
      const problems = await this.askForProblems(checked);
      if (turn !== this.checks) return;
      this.problems = problems;
      this.found(checked);
    }, EDITOR_CHECK_DELAY);
  }

  async askForProblems(checked) {
    try {
      const found = await this.hooks.check?.(structuredClone(checked));
      return (Array.isArray(found) ? found : []).map(problem => ({
        where: String(problem?.where ?? ""), message: String(problem?.message ?? problem),
      }));
    } catch (error) {
      return [{ where: "", message: `could not be checked: ${error?.message ?? error}` }];
    }
  }

  // Keys work wherever the focus is in the editor, or nowhere, as long as no control wants the key.
  keyDown(event) {
    const { target, key } = event;
    const isNowhere = target === document.body;
    if (event.defaultPrevented || !this.root.getClientRects().length || !(isNowhere || this.root.contains(target))) return;
    const field = target.closest("input, select, textarea");
    const isTyping = Boolean(field) && field.dataset.shown !== undefined && field.value !== field.dataset.shown;
    let isDone;
    if (event.ctrlKey || event.metaKey) isDone = this.controlKey(event, isTyping);
    else if (key === "Escape") isDone = this.escape(isNowhere || target === this.surface);
    else isDone = !field && !event.altKey && this.plainKey(event, target === this.surface, isNowhere);
    if (isDone) event.preventDefault();
  }

  // Undo and redo, unless a field that is being typed in has its own.
  controlKey({ key, shiftKey }, isTyping) {
    const letter = key.toLowerCase();
    if (isTyping || (letter !== "z" && letter !== "y")) return false;
    this.act(letter === "y" || shiftKey ? "redo" : "undo");
    return true;
  }
}
