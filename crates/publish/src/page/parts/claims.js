// Claims by verdict, words and label.

class Filter {
  constructor(form) {
    this.form = form;
    this.shown = document.getElementById('shown');
    this.claims = [...document.querySelectorAll('.claim')].map((element) => ({
      element, verdict: element.dataset.verdict, label: element.dataset.label, // as it is set, and as it is typed: a search for mu finds the letter
      text: `${element.textContent} ${element.dataset.words}`.toLowerCase(),
    }));
    form.addEventListener('input', () => this.apply());
    form.addEventListener('submit', (event) => event.preventDefault());
    // the fields have their first values only after the event
    form.addEventListener('reset', () => setTimeout(() => this.apply()));
    for (const link of document.querySelectorAll('.verdicts a')) link.addEventListener('click', () => this.only(link.dataset.verdict));
    for (const link of document.querySelectorAll('a[href^="#claim-"]')) link.addEventListener('click', () => form.reset());
    this.apply();
  }

  only(verdict) {
    this.form.reset();
    for (const box of this.form.elements.verdict) box.checked = box.value === verdict;
    setTimeout(() => {
      for (const box of this.form.elements.verdict) box.checked = box.value === verdict;
      this.apply();
    });
  }

  apply() {
    const verdicts = [...this.form.elements.verdict].filter((box) => box.checked).map((box) => box.value);
    const wanted = this.form.elements.words.value.toLowerCase().split(/\s+/).filter(Boolean);
    const label = this.form.elements.label.value;
    let count = 0;
    for (const claim of this.claims) {
      const fits = verdicts.includes(claim.verdict) && (!label || claim.label === label)
        && wanted.every((word) => claim.text.includes(word));
      claim.element.hidden = !fits;
      count += fits;
    }
    this.shown.textContent = `${count} of ${this.claims.length} claims shown`;
  }
}
