// The search field in the bar of each page. The index is loaded when the field is first used, by a
// script element, so that the site also works from a disk.
(() => {
  const script = document.currentScript.src
  const root = new URL(".", script).href
  let loading = null

  const load = () => {
    loading ||= new Promise((done, failed) => {
      const element = document.createElement("script")
      element.src = root + "search-index.js"
      element.onload = done
      element.onerror = failed
      document.head.append(element)
    })
    return loading
  }

  const words = text => text.toLowerCase().split(/[^\p{L}\p{N}_-]+/u).filter(w => w.length > 1)

  /** Sections with all words: those in titles count more, long sections less. Decisions come after
    * the pages that say how to do something.
    */
  const find = query => {
    const wanted = words(query)
    if (!wanted.length) return []
    return window.candelaIndex
      .map(([url, page, title, text]) => {
        const [p, t, b] = [page, title, text].map(s => s.toLowerCase())
        let score = 0
        for (const word of wanted) {
          const inText = b.split(word).length - 1
          const one = (t.includes(word) ? 20 : 0) + (p.includes(word) ? 10 : 0) +
            Math.min(inText, 5) * 3 / Math.log2(4 + b.length / 200)
          if (!one) return null
          score += one
        }
        if (url.includes("decisions/")) score /= 4
        return { url, page, title, text, score, wanted }
      })
      .filter(hit => hit)
      .sort((a, b) => b.score - a.score)
      .slice(0, 12)
  }

  const excerpt = hit => {
    const at = Math.max(0, hit.text.toLowerCase().indexOf(hit.wanted[0]) - 50)
    return (at ? "… " : "") + hit.text.slice(at, at + 140) + (at + 140 < hit.text.length ? " …" : "")
  }

  const element = (name, className, text) => {
    const made = document.createElement(name)
    made.className = className
    if (text) made.textContent = text
    return made
  }

  const start = () => {
    const box = document.querySelector("header .search")
    const field = element("input", "search-field")
    Object.assign(field, { type: "search", placeholder: "Search", autocomplete: "off" })
    field.setAttribute("aria-label", "Search all pages")
    const list = element("div", "search-results")
    list.hidden = true
    box.append(field, list)
    // The list of pages is open beside the text, and closed above it on a phone
    if (matchMedia("(max-width: 60rem)").matches) document.querySelector(".menu").open = false

    const show = async () => {
      try { await load() } catch { return }
      const hits = find(field.value)
      list.replaceChildren(...hits.map(hit => {
        const link = element("a", "search-hit")
        link.href = root + hit.url
        const title = hit.title === hit.page ? hit.page : hit.page + " › " + hit.title
        link.append(element("strong", "", title), element("span", "", excerpt(hit)))
        return link
      }))
      if (!hits.length && words(field.value).length) list.append(element("p", "", "nothing found"))
      list.hidden = !field.value
    }
    field.addEventListener("focus", load)
    field.addEventListener("input", show)
    field.addEventListener("keydown", event => {
      const first = list.querySelector("a")
      if (event.key === "Enter" && first) first.click()
      if (event.key === "Escape") { field.value = ""; list.hidden = true }
      if (event.key === "ArrowDown" && first) { first.focus(); event.preventDefault() }
    })
    list.addEventListener("keydown", event => {
      const next = event.key === "ArrowDown" ? "nextElementSibling" : "previousElementSibling"
      if (event.key.startsWith("Arrow")) {
        (document.activeElement[next] || field).focus()
        event.preventDefault()
      }
    })
    document.addEventListener("click", event => { if (!box.contains(event.target)) list.hidden = true })
    document.addEventListener("keydown", event => {
      if (event.key === "/" && !/input|textarea/i.test(event.target.tagName)) {
        field.focus()
        event.preventDefault()
      }
    })
  }
  document.readyState === "loading" ? document.addEventListener("DOMContentLoaded", start) : start()
})()
