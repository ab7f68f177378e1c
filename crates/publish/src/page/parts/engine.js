// The module, called with numbers and texts. The page and its workers read this file alike.

class Engine {
  /** `ears` hears of a run: `sample(numbers)`, `event(text)`, `checking()`. */
  constructor(module, ears = {}) {
    const view = (Type, pointer, count) => new Type(this.memory.buffer, pointer, count);
    const page = {
      sample: (pointer, count) => ears.sample?.(view(Float64Array, pointer, count)),
      event: (pointer, length) => ears.event?.(new TextDecoder().decode(view(Uint8Array, pointer, length))),
      checking: () => ears.checking?.(),
    };
    this.functions = new WebAssembly.Instance(module, { page }).exports;
    this.memory = this.functions.memory;
  }

  /** The bytes that a function answers with; throws its complaint as an `Error` whose message is the text of it. */
  bytes(name, ...values) {
    const length = this.functions[name](...values);
    // a view is taken after the call: a memory that grows leaves older ones empty
    const bytes = new Uint8Array(this.memory.buffer, this.functions.answer(), Math.abs(length)).slice();
    if (length < 0) throw new Error(new TextDecoder().decode(bytes));
    return bytes;
  }

  text(name, ...values) {
    return new TextDecoder().decode(this.bytes(name, ...values));
  }

  /** The answer, as JSON, of a function that reads a text. */
  about(text, name, ...values) {
    const bytes = new TextEncoder().encode(text);
    const place = this.functions.room(bytes.length);
    new Uint8Array(this.memory.buffer, place, bytes.length).set(bytes);
    return JSON.parse(this.text(name, ...values));
  }
}
