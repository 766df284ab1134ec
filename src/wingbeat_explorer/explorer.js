// wingbeat explorer, made by viewer/build.mjs; sources sha256:a49e13de7ce8e837bfa44b639796bf76aa6f7cbc4a1fc3b80eedd992e979797f
(()=>{var{Viewer:oe,Flight:ae,setView:re,viewOf:he,make:r,draw:m,capital:M,short:g,ticks:J,mount:le}=globalThis.wingbeatViewer;function C(i,e,t=3){return e?`${g(i,t)} ${e}`:g(i,t)}function E(i){return Array.isArray(i)?i:[i,i]}var N=i=>i.plausible===!1;function de(i){return i.certified?i.plausible===null?"certified, plausibility not known":`certified, ${i.plausible?"plausible":"not plausible"}`:"no certified wingbeat"}var w={left:46,right:16,top:14,bottom:38};function ce(i,e){let{x:t,y:s,width:n,height:o,xTicks:a,yTicks:h}=i,l=o-w.bottom,d=(p,u,f,c,x="wbx-tick")=>m("text",{x:p,y:u,"text-anchor":f,class:x},c);return m("g",{"aria-hidden":"true"},...h.flatMap(p=>[m("line",{class:"wbx-grid",x1:w.left,x2:n-w.right,y1:s(p),y2:s(p)}),d(w.left-7,s(p)+4,"end",String(p))]),...a.map(p=>d(t(p),l+16,"middle",String(p))),m("line",{class:"wbx-axis",x1:w.left,x2:n-w.right,y1:l,y2:l}),d(n-w.right,l+31,"end","speed [m/s]"),d(w.left+2,w.top-3,"start",`${e.label} [${e.unit}]`))}function pe(i,{x:e,y:t},s){let n=[];for(let o=1;o<i.length;o++){let[a,h]=[i[o-1],i[o]];if(!a.certified||!h.certified)continue;let l=[a,h].some(N)?"wbx-curve wbx-dashed":"wbx-curve",d={x1:e(a.speed),y1:t(a[s]),x2:e(h.speed),y2:t(h[s])};n.push(m("line",{class:l,...d}))}return m("g",{},...n)}function ue(i,{x:e,y:t,height:s},n){let o=i.map(a=>{let h=e(a.speed);return a.certified?m("circle",{class:N(a)?"wbx-dot wbx-hollow":"wbx-dot",cx:h,cy:t(a[n]),r:4}):nt(h,s-w.bottom-9)});return m("g",{},...o)}function fe(i,{x:e,height:t}){let s=t-w.bottom;return m("g",{},...i.map(n=>m("circle",{class:"wbx-pending",cx:e(n),cy:s,r:4})))}function nt(i,e){return m("path",{class:"wbx-gap",d:`M${i-4} ${e-4}l8 8m0-8l-8 8`})}function we(i,{x:e,y:t,height:s,width:n},o,a){let[h,l]=E(i.speed).map(e),[d,p]=i[o]===void 0?[]:E(i[o]).map(t),u=`${i.label}. Source: ${i.source}`,f={class:`wbx-measured wbx-${i.basis??"measured"}`,tabindex:"0",role:"img","aria-label":u,onpointerenter:()=>a(u),onpointerleave:()=>a(""),onfocus:()=>a(u),onblur:()=>a("")},c=p??w.top,x=d??s-w.bottom,T=Math.max(l-h,10),S=Math.max(x-c,10),O={x:Math.min((h+l-T)/2,n-w.right-T),y:(c+x-S)/2,width:T,height:S,rx:3};return m("g",f,m("rect",O))}var ot=400;function me({title:i,points:e},t,{x:s,y:n,height:o},{name:a,unit:h},l){let d=e.filter(c=>c[a]!==void 0),p=d.length<=ot,u=d.map(c=>{let[x,T]=[s(c.speed),n(c[a])],S=c[`${a}Error`],q=Math.min(n(c[a]-S),o-w.bottom),O=S?[m("path",{d:`M${x} ${n(c[a]+S)}V${q}`})]:[],I=m("path",{class:"wbx-own-mark",d:`M${x} ${T-5}l5 5l-5 5l-5 -5z`});if(!p)return m("g",{},...O,I);let Q=`${c.label||i}: ${C(c[a],h)} at ${C(c.speed,"m/s")}.`;return m("g",{onpointerenter:()=>l(Q),onpointerleave:()=>l("")},...O,I)}),f=`${i}: ${d.length} measured points of your own`;return m("g",{class:`wbx-own wbx-own-${t%3}`,role:"img","aria-label":f},...u)}var F=[{name:"power",label:"Power",unit:"W"},{name:"frequency",label:"Wingbeats",unit:"Hz"}],at={ArrowRight:1,ArrowUp:1,ArrowLeft:-1,ArrowDown:-1,PageUp:3,PageDown:-3},rt=.5,B=class{constructor(e,t){this.act=e,this.onslide=()=>{},this.snap=t,this.quantity=F[0],this.data={points:[],measured:[],pending:[]},this.own=[],this.speed=0,this.svg=m("svg",{class:"wbx-chart"}),this.buttons=F.map(o=>r("button",{type:"button","aria-pressed":"false",onclick:()=>this.choose(o)},o.label));let s=r("div",{class:"wbx-pair",role:"group","aria-label":"Curve shown"},...this.buttons);this.note=r("p",{class:"wbx-note"});let n=r("div",{class:"wbx-row"},r("h2",{},"Drag the point to fly faster or slower"),s);this.element=r("div",{class:"wbx-curve-box","data-part":"curve"},n,this.svg,this.note),this.buildHandle(),this.svg.addEventListener("pointerdown",o=>this.take(o)),this.svg.addEventListener("pointermove",o=>this.dragging&&this.drag(o));for(let o of["pointerup","pointercancel"])this.svg.addEventListener(o,()=>this.release());this.watcher=new ResizeObserver(()=>this.draw()),this.watcher.observe(this.svg),this.choose(F[0])}buildHandle(){this.guide=m("line",{class:"wbx-guide"}),this.knob=m("circle",{class:"wbx-knob",r:9}),this.tag=m("text",{class:"wbx-tag","text-anchor":"middle"});let e={role:"slider",tabindex:"0","aria-label":"Speed","aria-orientation":"horizontal"};this.handle=m("g",{class:"wbx-handle",...e},this.guide,this.knob,this.tag),this.handle.addEventListener("keydown",t=>this.key(t))}choose(e){this.quantity=e,this.buttons.forEach((t,s)=>t.setAttribute("aria-pressed",String(F[s]===e))),this.draw()}show({points:e,measured:t=[],range:s,pending:n=[]}){this.data={points:[...e].sort((o,a)=>o.speed-a.speed),measured:t,range:s,pending:n},this.draw()}showOwn(e){this.own=e,this.draw()}mark(e){this.dragging||(this.speed=e,this.place(e))}pin(e){e!==this.pinned&&(this.pinned=e,this.draw())}draw(){let{clientWidth:e,clientHeight:t}=this.svg;if(!e||!t)return;let{name:s}=this.quantity,{points:n}=this.data,o=d=>s==="power"&&d.frequency===void 0,a=this.data.measured.filter(d=>d[s]!==void 0||o(d));this.scale=this.scales(e,t,a),this.svg.setAttribute("viewBox",`0 0 ${e} ${t}`);let h=d=>this.note.textContent=d||this.legend(a),l=document.activeElement===this.handle;this.svg.replaceChildren(ce(this.scale,this.quantity),...a.map(d=>we(d,this.scale,s,h)),...this.own.map((d,p)=>me(d,p,this.scale,this.quantity,h)),pe(n,this.scale,s),fe(this.data.pending,this.scale),ue(n,this.scale,s),...this.drawPin(s),this.handle),l&&this.handle.focus({preventScroll:!0}),h(""),this.place(this.speed)}scales(e,t,s){let{points:n}=this.data,{name:o}=this.quantity,a=[...n.map(b=>b.speed),...this.data.range??[]],[h,l]=a.length?[Math.min(...a),Math.max(...a)]:[0,20],d=this.own.flatMap(b=>b.points),p=d.map(b=>b.speed),u=[h,l,...s.flatMap(({speed:b})=>E(b)),...p],f=Math.max(.04*(l-h),.2),[c,x]=[Math.max(Math.min(...u)-f,0),Math.max(...u)+f],T=n.filter(b=>b.certified).map(b=>b[o]),S=s.filter(b=>b[o]!==void 0).map(b=>E(b[o])[1]),q=d.filter(b=>b[o]!==void 0).map(b=>b[o]),O=1.12*Math.max(...T,...S,...q,1e-9),I=b=>w.left+(b-c)/(x-c)*(e-w.left-w.right),Q=b=>t-w.bottom-b/O*(t-w.bottom-w.top),st=b=>c+(b-w.left)/(e-w.left-w.right)*(x-c),it=J(c,x,e<500?5:10);return{x:I,y:Q,width:e,height:t,speedAt:st,first:h,last:l,xTicks:it,yTicks:J(0,O,4)}}drawPin(e){if(!this.pinned)return[];let{x:t,y:s}=this.scale,[n,o]=[t(this.pinned.speed),s(this.pinned[e])];return[m("path",{class:"wbx-pin",d:`M${n} ${o-8}l8 8l-8 8l-8 -8z`})]}legend(e){let{points:t}=this.data,s=[];return t.some(n=>n.certified&&N(n))&&s.push("dashed: not plausible"),t.some(n=>!n.certified)&&s.push("cross: no certified wingbeat"),this.data.pending.length&&s.push("rings on the axis: still to be computed"),e.length&&s.push("bars behind: real animals (point at one for its source)"),s.join("; ")}place(e){if(!this.scale)return;let{x:t,y:s,height:n,first:o,last:a}=this.scale,{name:h,unit:l}=this.quantity,d=t(Math.min(Math.max(e,o),a)),p=this.valueAt(e,h),u=n-w.bottom,f=p===void 0?u-9:s(p);for(let[S,q]of Object.entries({x1:d,x2:d,y1:f,y2:u}))this.guide.setAttribute(S,q);this.knob.setAttribute("cx",d),this.knob.setAttribute("cy",f),this.tag.setAttribute("x",d),this.tag.setAttribute("y",f<w.top+20?f+26:f-16);let c=this.nearest(e),x=c&&Math.abs(c.speed-e)<1e-9?c:void 0;this.tag.textContent=x?.certified&&!this.dragging?`${g(x[h])} ${l}`:"",this.handle.setAttribute("aria-valuemin",o),this.handle.setAttribute("aria-valuemax",a),this.handle.setAttribute("aria-valuenow",e);let T=x?.certified?`${g(x.power)} W, ${g(x.frequency)} Hz, `:"";this.handle.setAttribute("aria-valuetext",`${g(e)} m/s`+(x?`: ${T}${de(x)}`:""))}valueAt(e,t){let{points:s}=this.data,n=s.findIndex(l=>l.speed>=e-1e-9);if(n<0)return;let[o,a]=[s[n],s[n-1]];if(Math.abs(o.speed-e)<1e-9)return o.certified?o[t]:void 0;if(!a?.certified||!o.certified)return;let h=(e-a.speed)/(o.speed-a.speed);return a[t]+h*(o[t]-a[t])}nearest(e){let t=s=>Math.abs(s.speed-e);return this.data.points.reduce((s,n)=>s&&t(s)<=t(n)?s:n,void 0)}take(e){e.button!==0||!this.scale||(this.dragging=!0,this.svg.setPointerCapture(e.pointerId),this.handle.focus({preventScroll:!0}),this.drag(e))}drag(e){let{first:t,last:s,speedAt:n}=this.scale,o=e.clientX-this.svg.getBoundingClientRect().left,a=Math.min(Math.max(n(o),t),s);this.place(a),this.ask(this.snap?this.nearest(a)?.speed:Math.round(10*a)/10),this.onslide(a)}release(){this.dragging&&(this.dragging=!1,this.place(this.speed),this.onslide())}key(e){let t=at[e.key],s={Home:"first",End:"last"}[e.key];!t&&!s||e.ctrlKey||e.metaKey||e.altKey||!this.scale||(e.preventDefault(),e.stopPropagation(),s?this.ask(this.scale[s]):this.snap?this.ask(this.beside(t)):this.ask(Math.min(Math.max(this.speed+t*rt,this.scale.first),this.scale.last)),this.place(this.speed))}beside(e){let{points:t}=this.data,s=t.indexOf(this.nearest(this.speed));return t[Math.min(Math.max(s+e,0),t.length-1)]?.speed}ask(e){e===void 0||e===this.speed||(this.speed=e,this.act(e))}destroy(){this.watcher.disconnect()}};var be=2,W=class{constructor(){this.rows=new Map,this.element=r("ul",{class:"wbx-gauges","aria-label":"Numbers and their plausible ranges"})}show(e,t){let s=new Map((t??[]).map(a=>[a.name,a]));for(let a of e)this.rows.has(a.name)||this.rows.set(a.name,new Z),this.rows.get(a.name).show(a,s.get(a.name));let n=e.map(({name:a})=>this.rows.get(a).element);n.length===this.element.children.length&&n.every((a,h)=>a===this.element.children[h])||this.element.replaceChildren(...n)}},Z=class{constructor(){this.label=r("span",{class:"wbx-label"}),this.value=r("span",{class:"wbx-value"}),this.word=r("span",{class:"wbx-word"}),this.band=r("span",{class:"wbx-band"}),this.mark=r("span",{class:"wbx-mark"}),this.pinned=r("span",{class:"wbx-mark wbx-was"}),this.bar=r("span",{class:"wbx-bar","aria-hidden":"true"},this.band,this.pinned,this.mark),this.range=r("p"),this.source=r("p");let e=r("summary",{},this.label,this.value,this.word,this.bar);this.element=r("li",{},r("details",{},e,this.range,this.source))}show(e,t){let{label:s,value:n,unit:o,low:a,high:h,source:l}=e,d=a!==null||h!==null;this.element.dataset.gauge=e.name,this.label.textContent=s,this.value.textContent=n===null?"\u2013":C(n,o),this.value.dataset.exact=n,this.word.textContent=ht(e),this.element.className={true:"wbx-inside",false:"wbx-outside"}[e.inside]??"";let p=e.given?"Given, not predicted. ":"";this.range.textContent=p+(d?`Plausible: ${lt(e)}`:"No plausible range is known."),this.source.textContent=d?`Source: ${l}`:"";let u=h!==null?be*h:2.5*a,f=a!==null&&a<0?be*a:0,c=x=>`${100*Math.min(Math.max((x-f)/(u-f),0),1)}%`;this.bar.hidden=!d,d&&(this.band.style.left=c(a??f),this.band.style.right=`calc(100% - ${c(h??u)})`,this.put(this.mark,n,f,u,c),this.put(this.pinned,t?.value??null,f,u,c))}put(e,t,s,n,o){e.hidden=t===null,t!==null&&(e.style.left=o(t),e.classList.toggle("wbx-beyond",t>n||t<s))}};function ht({value:i,low:e,high:t,inside:s,limited:n,given:o}){return i===null?"not defined":e===null&&t===null?o?"given":"no range known":s?o?"given":n?"set by a limit":"inside":t!==null&&i>t?"above":"below"}function lt({low:i,high:e,unit:t}){return i===null?`at most ${C(e,t)}`:e===null?`at least ${C(i,t)}`:`${C(i,"")} to ${C(e,t)}`}var _=class{constructor(e){this.face=e,this.wanted=""}get name(){return this.wanted||(this.face.viewer?.pushes.name??"")}want(e){this.wanted=e}heard(){let{answer:e,viewer:t}=this.face;if(!(!this.wanted||!e||e.provisional))if(!t||this.face.pushSpeed(e)!==e.speed)this.wanted="";else if(!e.scene.pushes)this.face.onpush();else{let{wanted:s}=this;this.wanted="",t.pushes.open(s),this.face.onpushed()}}};var j=class{constructor(){this.texts=[]}add(e){this.texts.includes(e)||this.texts.push(e)}get told(){let e=this.texts.length-8;return e<=0?this.texts:[...this.texts.slice(0,8),`and ${e} more like these`]}};function xe(i){if(!(i.size<=2e6))return`The file has ${(i.size/1e6).toFixed(1)} MB; at most ${2e6/1e6} MB are read.`}function ve(i,e){let t=i.replace(/^\uFEFF/,"").split(/\r\n|\r|\n/).map((l,d)=>({line:l,at:d+1})).filter(({line:l})=>l.trim()&&!l.startsWith("#"));if(t.length<2){e.add("The file has no rows: the first line names the columns, and each line below it is one row.");return}let s=["	",";",","].find(l=>t[0].line.includes(l))??",",n=ge(t[0].line,s),o=t.slice(1).map(({line:l,at:d})=>({at:d,cells:ge(l,s)}));o.length>5e3&&e.add(`The file has ${o.length} rows; at most 5000 are read.`);for(let{at:l,cells:d}of o.slice(0,5e3)){let[p,u]=[d.length,n.length];p!==u&&e.add(`Line ${l} has ${p} cells, the header has ${u}.`)}let a=/^#\s*frequency\s*(?:\[hz\])?\s*=\s*(.+)$/im.exec(i),h=a?z(a[1].trim(),"frequency",1,e,{low:1e-9}):void 0;return{header:n,rows:o.slice(0,5e3),frequency:h}}function ge(i,e){let t=[""],s=!1;for(let n=0;n<i.length;n++){let o=i[n];o==='"'&&s&&i[n+1]==='"'?t[t.length-1]+=i[++n]:o==='"'?s=!s:o===e&&!s?t.push(""):t[t.length-1]+=o}return t.map(n=>n.trim())}var dt=["alpha","alphadeg","aoa","aoadeg","angleofattack","angleofattackdeg","\u03B1"],ct=["phase","time"];function ye(i){return i.split(/\r\n|\r|\n/,60).some(e=>{let s=e.toLowerCase().replace(/[[(][^\])]*[\])]/g,"").split(/[\t;,]/.test(e)?/[\t;,]/:/\s+/).map(o=>o.replace(/[^a-zα]/g,"")),n=(...o)=>o.some(a=>s.includes(a));return n("cl","liftcoefficient")&&n("cd","dragcoefficient",...dt)&&!n(...ct)})}function ke(i){let e=/[[(]([^\])]*)[\])]/.exec(i),s=i.replace(/[[(].*$/,"").toLowerCase().trim().split(/[\s_-]+/).filter(Boolean);if(e)return{words:s,unit:e[1].trim().toLowerCase()};for(let[n,o]of pt){let a=s.slice(-n.length);if(s.length>n.length&&n.every((h,l)=>h===a[l]))return{words:s.slice(0,-n.length),unit:o}}return{words:s,unit:""}}var pt=[[["m","s"],"m/s"],[["m/s"],"m/s"],[["km","h"],"km/h"],[["mps"],"m/s"],[["hz"],"hz"],[["w"],"w"],[["mw"],"mw"],[["s"],"s"],[["ms"],"ms"],[["deg"],"deg"],[["degrees"],"deg"],[["rad"],"rad"]];function z(i,e,t,s,{low:n=-1/0,high:o=1/0}={}){if(i===void 0||/^(|na|n\/a|nan|-)$/i.test(i))return;if(/^[+-]?\d+,\d+$/.test(i))return s.add(`Line ${t}, ${e}: \u201C${i}\u201D has a decimal comma; write a decimal point.`),NaN;let a=/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(i)?Number(i):NaN;if(!Number.isFinite(a))return s.add(`Line ${t}, ${e}: \u201C${i.slice(0,40)}\u201D is no number.`),NaN;if(a<n||a>o){let h=o===1/0?`at least ${n}`:`from ${n} to ${o}`;return s.add(`Line ${t}, ${e}: ${i} must be ${h}.`),NaN}return a}var ut=["speed","airspeed","velocity","v","u"],$e=["power","p"],ft=["metabolic","metab","met","input","respirometry","aerobic","chemical"],Se=["frequency","freq","f","beats"],wt=["error","err","sd","se","sem","std","uncertainty"],mt=["label","name","animal","individual","species","source"],bt={speed:["m/s","ms-1","m s-1"],power:["w"],frequency:["hz","1/s","s-1"]},gt={speed:"m/s",power:"W",frequency:"Hz"},ee=(i,e)=>e.includes(i.at(-1));function Te(i){let e=i.map((o,a)=>({text:o,place:a,...ke(o)})),t=o=>o.words.some(a=>wt.includes(a)),s=e.find(o=>ee(o.words,ut)&&!t(o));if(s)return{kind:"flights",columns:xt(e,s,t)};let n=e.find(o=>["phase","time","t"].includes(o.words[0])&&o.words.length===1);return n?{kind:"motion",clock:n,columns:e.filter(o=>o!==n)}:{kind:void 0}}function xt(i,e,t){let s={speed:e},n=o=>o.words.some(a=>ft.includes(a));s.metabolic=i.find(o=>n(o)&&!t(o)),s.power=i.find(o=>ee(o.words,$e)&&!n(o)&&!t(o)),s.frequency=i.find(o=>ee(o.words,Se)&&!t(o));for(let o of i.filter(a=>t(a)&&!n(a))){let a=o.words.some(h=>Se.includes(h))?"frequency":o.words.some(h=>$e.includes(h))||s.power?"power":"frequency";s[`${a}Error`]??=o}return s.label=i.find(o=>o.words.some(a=>mt.includes(a))),s}function Ce({rows:i},e,t){for(let[o,a]of Object.entries(bt))for(let h of[e[o],e[`${o}Error`]])h?.unit&&!a.includes(h.unit)&&t.add(`Column \u201C${h.text}\u201D is in ${h.unit}; convert it to ${gt[o]}.`);e.metabolic&&!e.power&&!e.frequency?t.add(`Column \u201C${e.metabolic.text}\u201D is metabolic power; the curve shows mechanical power. wingbeat curve --data compares both.`):!e.power&&!e.frequency&&t.add("No column is named power or frequency; at least one of them must stand beside the speed.");let s={speed:{low:0,high:200}},n=[];for(let{at:o,cells:a}of i){let h={label:a[e.label?.place]??""};for(let l of["speed","power","frequency","powerError","frequencyError"]){let d=e[l];d&&(h[l]=z(a[d.place],d.text,o,t,s[l]??{low:0}))}h.speed===void 0&&t.add(`Line ${o} has no speed.`),(h.power!==void 0||h.frequency!==void 0)&&n.push(h)}return!n.length&&!t.texts.length&&t.add("No row has a speed with a power or a frequency."),n}function Me(i,e,t,s){let{rows:n}=i;n.length<3&&s.add("A wingbeat needs at least three rows.");let o=vt(i,e,s),a=o.map((l,d)=>d).sort((l,d)=>o[l]-o[d]),h=a.map(l=>o[l]);return t.map(l=>St(l,a.map(d=>n[d]),h,s))}function vt({rows:i,frequency:e},t,s){let n=t.words[0]!=="phase",o=["","s","ms"].includes(t.unit);n&&!o&&s.add(`Column \u201C${t.text}\u201D must be in s or ms.`);let a=n?{}:{low:0,high:1},h=i.map(({at:u,cells:f})=>{let c=z(f[t.place],t.text,u,s,a);return c===void 0&&s.add(`Line ${u} has no ${n?"time":"phase"}.`),c});if(!n)return h;let[l,d]=[h[0],h.at(-1)];if(!e)return d>l||s.add(`Column \u201C${t.text}\u201D: the last time must be later than the first.`),h.map(u=>(u-l)/(d-l));let p=e*(t.unit==="ms"?.001:1);return h.map(u=>((u-l)*p%1+1)%1)}var yt={pitch:"wing_pitch",span_fraction:"span_ratio"},kt=["","-","1","rad","rad/s","m","m/s","n","w","s","hz"],$t=["flap","pitch","twist","fold","sweep","alpha"];function St({text:i,words:e,unit:t,place:s},n,o,a){let h=e.some(f=>$t.includes(f))&&!e.includes("rate"),l=["deg","degrees","\xB0","deg/s"].includes(t);!l&&!kt.includes(t)?a.add(`Column \u201C${i}\u201D is in ${t}; convert it to SI units.`):h&&!l&&t!=="rad"&&a.add(`Column \u201C${i}\u201D is an angle: name its unit, as in \u201C${e.join("_")}_deg\u201D.`);let d=l?Math.PI/180:1,p=n.map(({at:f,cells:c})=>{let x=z(c[s],i,f,a);return d*(x??NaN)}),u=e.join("_");return{name:yt[u]??u,title:i,phase:o,values:p}}var Tt="A CSV file of measured flights has the columns speed [m/s] and mechanical power [W] or frequency [Hz], and may have error and label. A CSV file of a wingbeat has phase or time [s], and columns such as flap_deg or pitch_deg. With time, the rows are one beat from the first to the last, unless a line \u201C# frequency [Hz] = 8.2\u201D says how long a beat is. A polar has alpha, CL and CD; those of XFOIL, XFLR5, AeroDyn and others are read as they are.",Ct="The first line must name the columns: speed with power or frequency, for measured flights; phase or time with flap_deg and others, for a wingbeat; or alpha, CL and CD, for a polar.",Mt="Drop a file anywhere on this page, or choose one. A CSV file of flights or a wingbeat stays in your browser: nothing of it is uploaded.",At=/\.(dat|pol|plr|polar|drg|lft)$/i,Ae=i=>/\s/.test(i)?`"${i}"`:i,D=class{constructor(e){this.face=e,this.shown=[];let t={type:"file",multiple:!0,accept:".csv,.txt,.tsv,.toml,.dat,.pol,.plr,.polar,.drg,.lft"};this.input=r("input",{...t,onchange:()=>this.chosen()});let s=r("label",{class:"wbx-file"},r("span",{},"Choose a file"),this.input);this.list=r("ul",{class:"wbx-own-list"}),this.state=r("div",{class:"wbx-own-state",role:"status"}),this.element=r("section",{class:"wbx-own-data"},r("h2",{},"Your own data"),r("p",{},Mt),s,this.list,this.state,r("details",{class:"wbx-more"},r("summary",{},"What the file must hold"),r("p",{},Tt))),this.listen()}listen(){let e=new AbortController,t=a=>a.dataTransfer?.types.includes("Files"),{signal:s}=e,n=(a,h)=>document.addEventListener(a,l=>t(l)&&h(l),{signal:s}),o=a=>this.face.root.classList.toggle("wbx-dropping",a);n("dragover",a=>{a.preventDefault(),o(!0)}),n("dragleave",a=>a.relatedTarget===null&&o(!1)),n("drop",a=>{a.preventDefault(),o(!1),this.take([...a.dataTransfer.files])}),this.destroy=()=>e.abort()}chosen(){this.take([...this.input.files]),this.input.value=""}async take(e){this.state.replaceChildren(),this.sent={};for(let t of e)await this.read(t)}async read(e){if(!/\.(csv|tsv|txt)$/i.test(e.name))return this.other(e);let t=new j,s=xe(e),n=s?"":await e.text();if(ye(n))return this.other(e,!0);s?t.add(s):this.interpret(e.name,n,t),t.texts.length&&this.refuse(e.name,t.told)}interpret(e,t,s){let n=ve(t,s);if(!n)return;let{kind:o,clock:a,columns:h}=Te(n.header);if(o==="flights"){let l=h.metabolic&&`; not drawn, because the curve shows mechanical power: ${h.metabolic.text}`;this.add({title:e,kind:o,points:Ce(n,h,s),left:l??""},s)}else o==="motion"?this.add({title:e,kind:o,curves:Me(n,a,h,s)},s):s.add(Ct)}other(e,t=At.test(e.name)){if(this.face.onfile)return this.send(e,t?"polar":"species file");if(t)return this.fly(e.name);if(!/\.toml$/i.test(e.name))return this.refuse(e.name,["Its name must end in .csv, in .toml for a species file, or in .pol or .dat for a polar."]);let s=`wingbeat explore --static my-explorer --animals ${Ae(e.name)}`,n=`${e.name} is a species file. Its flights must be solved, which this page cannot do.`;this.say(r("p",{},`${n} This command makes a page with them:`),r("code",{},s))}send(e,t){let s=this.sent[t];return s?this.refuse(e.name,[`${s} is read, and a flight has one ${t}. Drop this one alone.`]):(this.sent[t]=e.name,this.face.onfile(e))}fly(e){let{species:t,speed:s}=this.face.answer??{species:"pigeon",speed:10},n=`${e} is a polar. Flights with it must be solved, which this page cannot do.`,o=`wingbeat orbit ${t} --speed ${s} --aero ${Ae(e)}`;this.say(r("p",{},`${n} This command flies it:`),r("code",{},o))}refuse(e,t){this.say(r("p",{},`${e} is not shown:`),r("ul",{},...t.map(s=>r("li",{},s))))}say(...e){this.state.append(...e),this.state.scrollIntoView({block:"nearest"})}add(e,t){t.texts.length||(this.shown=[...this.shown.filter(({title:s})=>s!==e.title),e],this.show(),e.points&&this.face.curve.element.scrollIntoView({block:"nearest"}))}remove(e){this.shown=this.shown.filter(t=>t!==e),this.show(),this.input.focus()}show(){let e=this.shown.filter(({kind:t})=>t==="flights");this.face.curve.showOwn(e),this.overlay(),this.list.replaceChildren(...this.shown.map(t=>this.row(t,e.indexOf(t))))}overlay(){let{viewer:e}=this.face,t=this.shown.flatMap(({title:s,curves:n=[]})=>n.map(o=>({...o,file:s})));this.drawn=e?.overlay(t)??[]}row(e,t){let s=t<0?"wbx-own-line":`wbx-own-${t%3}`,n=r("span",{class:`wbx-own-key ${s}`,"aria-hidden":"true"}),o={type:"button","aria-label":`Remove ${e.title}`},a=r("button",{...o,onclick:()=>this.remove(e)},"Remove");return r("li",{},n,r("span",{},this.words(e)),a)}words({title:e,points:t,curves:s,left:n}){let{viewer:o,blind:a}=this.face;if(t)return`${e}: ${t.length} ${t.length===1?"point":"points"} behind the curve${n}`;if(!o)return`${e}: ${a?"not drawn, because the page has no picture":"drawn with the first picture"}`;let[h,l]=[!0,!1].map(p=>s.filter(({name:f})=>this.drawn.includes(f)===p).map(f=>f.title).join(", ")),d=l&&`; not drawn, because the plots have no such series: ${l}`;return h?`${e}: ${h} as dashed lines in the plots${d}`:`${e}${d}`}};var U=class{constructor(e){this.onpin=void 0,this.answer=void 0,this.ghost=!0,this.act=e,this.button=r("button",{type:"button",onclick:()=>this.toggle()}),this.way=r("button",{type:"button",onclick:()=>this.turn()}),this.words=r("p"),this.element=r("div",{class:"wbx-pins"},this.button,this.way,this.words),this.tell()}now(e){this.current=e,this.button.disabled=!e.scene&&!this.answer}toggle(){this.onpin?this.onpin(!this.answer):this.pin(this.answer?void 0:this.current)}pin(e){this.answer=e,this.tell(),this.act()}turn(){this.ghost=!this.ghost,this.tell(),this.act()}tell(){this.button.textContent=this.answer?"Remove the comparison":"Pin this flight to compare",this.way.textContent=this.ghost?"Show side by side":"Show as a ghost",this.way.hidden=this.words.hidden=!this.answer;let e=this.ghost?"shown pale":"farther away in the side view";this.words.textContent=this.answer?`Pinned, ${e}: ${Oe(this.answer)}.`:""}scene(e){if(!this.answer?.scene)return e.scene;let[t,s]=[e,this.answer].map(n=>({...n.scene.flights[0],label:Oe(n)}));return{...e.scene,flights:[t,s]}}};function Oe({title:i,speed:e,model_title:t}){return`${i} at ${g(e)} m/s, model: ${t}`}var qe=`.wbx-row {
  display: flex;
  align-items: center;
  justify-content: space-between;
  gap: 8px 16px;
}
.wbx-pair {
  display: flex;
  gap: 6px;
}
.wbx-chart {
  display: block;
  width: 100%;
  height: 210px;
  touch-action: pan-y;
  cursor: ew-resize;
  user-select: none;
}
.wbx-chart text {
  fill: var(--soft);
  font-size: 12px;
}
.wbx-chart .wbx-tag {
  fill: var(--accent);
  font-size: 14px;
  font-weight: 650;
  paint-order: stroke;
  stroke: var(--paper);
  stroke-width: 4px;
}
.wbx-grid {
  stroke: var(--line);
  stroke-width: 1;
}
.wbx-axis {
  stroke: var(--soft);
  stroke-width: 1;
}
.wbx-curve {
  stroke: var(--ink);
  stroke-width: 2.5;
  stroke-linecap: round;
}
.wbx-dashed {
  stroke-dasharray: 2 6;
}
.wbx-dot {
  fill: var(--ink);
  stroke: var(--ink);
  stroke-width: 2;
}
.wbx-hollow {
  fill: var(--paper);
}
.wbx-pending {
  fill: var(--paper);
  stroke: var(--soft);
  stroke-width: 1.5;
  stroke-dasharray: 2 2;
}
.wbx-gap {
  stroke: var(--bad);
  stroke-width: 2;
  stroke-linecap: round;
}
.wbx-measured rect {
  fill: var(--animals);
  fill-opacity: 0.28;
  stroke: var(--animals);
  stroke-opacity: 0.7;
}
.wbx-law rect,
.wbx-estimated rect {
  fill-opacity: 0.1;
  stroke-dasharray: 3 4;
}
.wbx-measured:hover rect,
.wbx-measured:focus-visible rect {
  fill-opacity: 0.5;
}
.wbx-pin {
  fill: none;
  stroke: var(--accent);
  stroke-width: 2;
}
.wbx-guide {
  stroke: var(--accent);
  stroke-width: 1.5;
}
.wbx-knob {
  fill: var(--accent);
  stroke: var(--paper);
  stroke-width: 3;
}
.wbx-handle:focus-visible {
  outline: none;
}
.wbx-handle:focus-visible .wbx-knob {
  stroke: var(--ink);
}
.wbx-note {
  color: var(--soft);
  font-size: 12.5px;
  min-height: 1.45em;
}
/* Before the first answer there is nothing to drag or to judge. */
.wbx:not([data-status]) :is(.wbx-curve-box, .wbx-judged) {
  visibility: hidden;
}
@media (max-width: 599px) {
  .wbx-row h2 {
    font-size: 13px;
  }
}
`;var Ee=`.wbx-say {
  display: flex;
  flex-direction: column;
  gap: 12px;
}
.wbx-sentence {
  font-size: clamp(20px, 2.05vw, 30px);
  font-weight: 500;
  line-height: 1.22;
  letter-spacing: -0.012em;
  text-wrap: balance;
  min-height: 2.44em;
}
.wbx[data-status]:not([data-status="converged"]) .wbx-sentence {
  min-height: 0;
}
.wbx-sentence b {
  font-weight: 650;
  color: var(--accent);
  font-variant-numeric: tabular-nums;
  white-space: nowrap;
}
.wbx-choices {
  display: flex;
  gap: 8px 20px;
}
.wbx-choice {
  display: inline-flex;
  align-items: center;
  gap: 8px;
  min-width: 0;
}
.wbx-choice label {
  color: var(--soft);
}
.wbx-choice select {
  min-width: 0;
  text-overflow: ellipsis;
  font-weight: 600;
}
.wbx-lights {
  display: flex;
  flex-direction: column;
  gap: 8px;
}
.wbx-light {
  display: flex;
  gap: 10px;
  line-height: 1.35;
}
.wbx-sign {
  flex: none;
  width: 22px;
  height: 22px;
  border-radius: 50%;
  color: var(--paper);
  background: var(--good);
  font-weight: 700;
  text-align: center;
  line-height: 22px;
}
.wbx-bad .wbx-sign {
  background: var(--bad);
  border-radius: 5px;
}
.wbx-open .wbx-sign {
  color: var(--ink);
  background: none;
  border: 2px dashed var(--soft);
  line-height: 18px;
}
.wbx-why,
.wbx-warnings {
  color: var(--soft);
  font-size: 13px;
}
.wbx-warnings {
  margin-top: 8px;
}
.wbx-warnings ul {
  max-height: 6lh; /* whole lines: half a line looks like a fault */
  overflow: auto;
  scrollbar-gutter: stable;
  padding-left: 1.1em;
  list-style: disc;
}
.wbx-picture {
  position: relative;
}
.wbx .wb-viewer {
  padding: 0;
  gap: 6px;
}
.wbx .wb-picture {
  aspect-ratio: auto;
  height: clamp(250px, calc(100vh - 500px - var(--wbx-above, 0px)), 680px);
  min-height: 0;
  max-height: none;
  border: 0;
  border-radius: 14px;
  background: var(--shade);
}
.wbx .wb-warning {
  padding: 2px 10px;
  border-radius: 20px;
  color: var(--paper);
  background: var(--bad);
  font-size: 13px;
}
.wbx .wbx-between {
  background: var(--soft);
}
.wbx-state:empty {
  display: none;
}
.wbx-push {
  align-self: start;
}
/* Beside the folded views, where both have room, so that the curve begins higher. */
@media (min-width: 600px) {
  .wbx-picture:has(.wb-folded:not([open])) + .wbx-push {
    position: relative;
    align-self: end;
    margin-top: -36px;
  }
}
@media (min-width: 600px) {
  .wbx-narrow {
    display: none;
  }
}
@media (max-width: 599px) {
  .wbx-choice label,
  .wbx .wb-player label {
    position: absolute;
    clip-path: inset(50%);
  }
  .wbx-choices {
    display: grid;
    grid-template-columns: repeat(2, minmax(0, 1fr));
    gap: 8px;
  }
  .wbx-choice select {
    width: 100%;
  }
  .wbx-sentence {
    font-size: 19px;
    min-height: 4.88em;
  }
  .wbx-lights {
    flex-direction: row;
    flex-wrap: wrap;
    gap: 6px 16px;
  }
  .wbx .wb-picture {
    height: min(300px, 42vh);
  }
  .wbx .wb-player {
    flex-wrap: nowrap;
    gap: 10px;
  }
  .wbx .wb-readout {
    display: none;
  }
  .wbx-why {
    display: none;
  }
}
`;var Le=`.wbx-judged {
  display: flex;
  flex-direction: column;
  gap: 12px;
  min-width: 0;
}
.wbx-gauges {
  display: flex;
  flex-direction: column;
  gap: 12px;
}
.wbx-gauges summary {
  display: grid;
  grid-template-columns: 1fr auto;
  gap: 1px 10px;
  list-style: none;
}
.wbx-gauges summary::-webkit-details-marker {
  display: none;
}
.wbx-gauges p {
  margin-top: 4px;
  color: var(--soft);
  font-size: 12.5px;
  overflow-wrap: anywhere;
}
.wbx-label {
  color: var(--soft);
}
.wbx-value {
  grid-column: 1;
  grid-row: 2;
  font-size: 21px;
  font-weight: 600;
  line-height: 1.2;
  font-variant-numeric: tabular-nums;
}
.wbx-word {
  grid-column: 2;
  grid-row: 2;
  align-self: end;
  color: var(--soft);
}
.wbx-inside .wbx-word {
  color: var(--good);
}
.wbx-outside .wbx-word {
  color: var(--bad);
  font-weight: 600;
}
.wbx-bar {
  grid-column: 1 / -1;
  position: relative;
  height: 10px;
  margin: 5px 0 3px;
  border-radius: 5px;
  background: var(--shade);
}
.wbx-band {
  position: absolute;
  inset: 0;
  border-radius: 5px;
  background: var(--band);
}
.wbx-mark {
  position: absolute;
  top: -4px;
  width: 4px;
  height: 18px;
  margin-left: -2px;
  border-radius: 2px;
  background: var(--ink);
}
.wbx-outside .wbx-mark {
  background: var(--bad);
}
.wbx-beyond {
  width: 0;
  height: 0;
  margin-left: -6px;
  border: 9px solid transparent;
  border-left: 11px solid var(--bad);
  border-right: 0;
  border-radius: 0;
  background: none;
}
.wbx-outside .wbx-beyond {
  background: none;
}
.wbx-mark.wbx-was {
  width: 8px;
  margin-left: -4px;
  border: 2px solid var(--accent);
  background: none;
}
.wbx-pins {
  display: flex;
  flex-wrap: wrap;
  gap: 8px;
}
.wbx-pins p {
  flex: 1 1 100%;
  color: var(--soft);
  font-size: 13px;
}
.wbx-more {
  font-size: 13px;
}
.wbx-more summary {
  color: var(--soft);
}
.wbx-more table {
  border-collapse: collapse;
  margin-top: 6px;
}
.wbx-more th {
  text-align: left;
  font-weight: 400;
  padding: 2px 10px 2px 0;
}
.wbx-more td {
  padding: 2px 8px 2px 0;
  text-align: right;
  font-variant-numeric: tabular-nums;
}
.wbx-more td:last-child {
  text-align: left;
}
@media (max-width: 899px) {
  .wbx-judged {
    order: 1;
  }
}
`;var Ne=`.wbx-own-data {
  display: flex;
  flex-direction: column;
  align-items: start;
  gap: 8px;
  color: var(--soft);
  font-size: 13px;
}
.wbx-own-data h2 {
  color: var(--ink);
}
.wbx-file {
  position: relative;
  padding: 5px 12px;
  color: var(--ink);
  background: var(--shade);
  border: 1px dashed var(--soft);
  border-radius: 8px;
  font-size: 15px;
}
.wbx-file input {
  position: absolute;
  inset: 0;
  width: 100%;
  opacity: 0;
  cursor: pointer;
}
.wbx-file:hover,
.wbx-dropping .wbx-file {
  border-color: var(--accent);
}
.wbx-file:focus-within {
  outline: 2px solid var(--accent);
  outline-offset: 2px;
}
.wbx-dropping {
  outline: 3px dashed var(--accent);
  outline-offset: -6px;
}
.wbx-own-list li {
  display: flex;
  align-items: center;
  gap: 10px;
  padding: 2px 0;
  color: var(--ink);
}
.wbx-own-key {
  flex: none;
  width: 11px;
  height: 11px;
  transform: rotate(45deg) scale(0.8);
  background: var(--own);
}
.wbx-own-key.wbx-own-line {
  width: 20px;
  height: 0;
  transform: none;
  background: none;
  border-top: 2.5px dashed var(--own);
}
.wbx-own-state:empty {
  display: none;
}
.wbx-own-state {
  color: var(--ink);
}
.wbx-own-state ul {
  padding-left: 1.2em;
  list-style: disc;
}
.wbx-own-state code {
  display: block;
  margin-top: 4px;
  padding: 6px 10px;
  border-radius: 6px;
  background: var(--shade);
  overflow-wrap: anywhere;
}
.wbx {
  --own: light-dark(#7a2e8f, #d9a3ea);
}
.wbx-own-1 {
  --own: light-dark(#0a6b6b, #6fd0cb);
}
.wbx-own-2 {
  --own: light-dark(#a02a55, #ff9fbf);
}
.wbx-own path {
  stroke: var(--own);
  stroke-width: 1.5;
  fill: none;
}
.wbx-own .wbx-own-mark {
  fill: var(--own);
  fill-opacity: 0.35;
}
`;var ze=`.wbx {
  color-scheme: light dark;
  --ink: light-dark(#1c2128, #e9ecf1);
  --paper: light-dark(#ffffff, #14181d);
  --soft: light-dark(#57606c, #a4adb8);
  --line: light-dark(#d9dde3, #343c46);
  --shade: light-dark(#f0f2f5, #1f252c);
  --accent: light-dark(#0b5cad, #6db3f2);
  --good: light-dark(#176639, #7fd6a0);
  --bad: light-dark(#a3261b, #ff9c91);
  --band: light-dark(#bfe3cd, #23523a);
  --animals: light-dark(#8a5300, #f0bd62);
  color: var(--ink);
  background: var(--paper);
  font: 15px/1.45 system-ui, sans-serif;
  display: grid;
  grid-template-columns: minmax(0, 1fr) 320px;
  grid-template-rows: auto 1fr;
  gap: 12px 28px;
  padding: 20px 24px 24px;
}
.wbx[data-theme="light"] {
  color-scheme: light;
}
.wbx[data-theme="dark"] {
  color-scheme: dark;
}
.wbx *,
.wbx *::before {
  box-sizing: border-box;
}
.wbx [hidden] {
  display: none;
}
.wbx :focus-visible {
  outline: 2px solid var(--accent);
  outline-offset: 2px;
}
.wbx h1,
.wbx h2,
.wbx p,
.wbx ul {
  margin: 0;
  padding: 0;
}
.wbx ul {
  list-style: none;
}
.wbx h2 {
  font-size: 15px;
  font-weight: 600;
}
.wbx button,
.wbx select {
  font: inherit;
  color: var(--ink);
  background: var(--shade);
  border: 1px solid var(--line);
  border-radius: 8px;
  min-height: 34px;
  padding: 3px 12px;
  cursor: pointer;
}
.wbx button:disabled {
  color: var(--soft);
  cursor: default;
}
.wbx button:hover,
.wbx select:hover {
  border-color: var(--accent);
}
.wbx button[aria-pressed="true"] {
  color: var(--accent);
  border-color: var(--accent);
}
.wbx summary {
  cursor: pointer;
}
.wbx-unseen {
  position: absolute;
  width: 1px;
  height: 1px;
  overflow: hidden;
  clip-path: inset(50%);
}
.wbx-stage {
  display: flex;
  flex-direction: column;
  gap: 10px;
  min-width: 0;
}
.wbx-side {
  grid-column: 2;
  grid-row: 1 / 3;
}
.wbx-extras {
  grid-column: 1 / -1;
  display: grid;
  grid-template-columns: minmax(0, 1fr) minmax(0, 1fr);
  gap: 24px 48px;
  padding-top: 18px;
  border-top: 1px solid var(--line);
}
@media (min-width: 900px) {
  .wbx-side {
    display: flex;
    flex-direction: column;
    gap: 18px;
    min-width: 0;
    border-left: 1px solid var(--line);
    padding-left: 24px;
    margin-left: -4px;
  }
}
@media (max-width: 899px) {
  .wbx {
    display: flex;
    flex-direction: column;
    padding: 12px 14px 20px;
  }
  .wbx-side {
    display: contents;
  }
  .wbx-extras {
    order: 9;
    grid-template-columns: minmax(0, 1fr);
  }
}
`;var Pe=`.wbx-tours ul {
  display: grid;
  grid-template-columns: repeat(auto-fill, minmax(230px, 1fr));
  gap: 14px 20px;
  margin-top: 10px;
}
.wbx-tours li {
  display: flex;
  flex-direction: column;
  align-items: start;
  gap: 4px;
  color: var(--soft);
  font-size: 13px;
}
.wbx-tours button {
  font-weight: 600;
  font-size: 15px;
}
.wbx-tour {
  position: fixed;
  z-index: 10;
  right: 24px;
  bottom: 24px;
  width: 348px;
  display: flex;
  flex-direction: column;
  gap: 8px;
  padding: 12px 18px 16px;
  color: var(--ink);
  background: var(--paper);
  border: 1px solid var(--line);
  border-top: 4px solid var(--accent);
  border-radius: 12px;
  box-shadow: 0 8px 30px rgb(0 0 0 / 0.24);
}
.wbx-tour h2 {
  font-size: 19px;
  line-height: 1.25;
}
.wbx-tour h2:focus-visible {
  outline: none;
}
.wbx-hint {
  color: var(--soft);
  font-size: 12.5px;
}
.wbx-tour-text {
  display: flex;
  flex-direction: column;
  gap: 7px;
}
.wbx-tour-text b {
  color: var(--accent);
  font-weight: 650;
  font-variant-numeric: tabular-nums;
}
.wbx-tour .wbx-row > :last-child {
  margin-left: auto;
}
.wbx-tour button:disabled,
.wbx-tours button:disabled {
  opacity: 0.45;
  cursor: default;
}
.wbx-tour .wbx-close {
  padding: 0 10px;
  font-size: 18px;
  line-height: 1;
}
.wbx-tour [data-go="next"] {
  color: var(--paper);
  background: var(--accent);
  border-color: var(--accent);
  font-weight: 600;
}
.wbx [data-part],
.wbx-own-state,
.wbx .wb-picture {
  scroll-margin: 12px;
}
.wbx[data-tour] {
  padding-bottom: 300px;
}
.wbx[data-look="curve"] [data-part="curve"],
.wbx[data-look="gauges"] .wbx-gauges {
  outline: 2px solid var(--accent);
  outline-offset: 8px;
  border-radius: 6px;
}
@media (max-width: 599px) {
  .wbx-tour {
    inset: auto 0 0;
    width: auto;
    max-height: 46vh;
    overflow: auto;
    padding: 8px 14px 12px;
    border-radius: 14px 14px 0 0;
  }
  .wbx-tour h2 {
    font-size: 17px;
  }
  .wbx[data-tour] [data-part],
  .wbx[data-tour] .wb-picture {
    scroll-margin-bottom: 48vh;
  }
  .wbx[data-tour] {
    padding-bottom: 50vh;
  }
}
`;var Re=ze+Ee+qe+Le+Ne+Pe;var v=i=>`${g(i)} W`,y=i=>i.speed?`at ${g(i.speed)} m/s`:"in hover",Ie=i=>`${g(100*i,2)} %`;function te(i,e){let t=i.numbers.find(([s])=>s===e);return t&&[t[1],t[2]].filter(Boolean).join(" ")}function se(i,e){return i.gauges.find(t=>t.name===e&&t.value!==null)}var k=(i,e)=>i?[e(i)]:[];function $(i,e,t=v){let[s,n]=[t(i),t(e)];return s===n?`stays at ${n}`:`${e>i?"rises":"falls"} from ${s} to ${n}`}function Fe({spent:i},e){let t=Object.values(i).reduce((s,n)=>s+n,0);return i[e]/t}var Pt=/(\d[\d.]*(?:e[+-]?\d+)? (?:m\/s|W\/kg|W|Hz|%|deg|g|m|beats?)(?![\w/]))/;function Be(i){return i.split(Pt).map((e,t)=>t%2?r("b",{},e):e)}var Rt={profile:"profile power, the drag of the wings",induced:"induced power itself",parasite:"the drag of body and tail",unsteady:"that of rotation and added mass"};function We({spent:i}){let[e,t]=Object.entries(i).reduce((s,n)=>n[1]>s[1]?n:s);return`${Rt[e]}, with ${v(t)}`}function _e({value:i,low:e,high:t,unit:s,inside:n}){let o=h=>[g(h),s].filter(Boolean).join(" ");if(n===null)return`${o(i)}; no plausible range is known`;if(n)return`${o(i)}, inside the plausible range`;let a=i>t?`at most ${o(t)}`:`at least ${o(e)}`;return`${o(i)}; plausible is ${a}`}var It={upward:"from below",downward:"from above",head:"from ahead",tail:"from behind"};function H({direction:i,size:e}){return`a gust ${It[i]} of up to ${g(e)} m/s`}var A=i=>`${g(i)} Hz`,je=i=>`${g(i)} m`;function De(i){let e=se(i,"flap_amplitude");return e?[`The wings flap ${g(e.value)} ${e.unit} to either side of their mean.`]:[]}function Ue(i,e){return i>=e?"has enough for that":`would lack ${v(e-i)}`}function He(i){let e=te(i,"a small disturbance");return e==="decays"?["A small disturbance decays."]:e==="grows"?["But a small disturbance grows, as long as the wingbeat does not react."]:[]}var P={animal:"robofalcon2",model:["paper","animal"]},Ge={name:"robot",title:"Build a robot",teaser:"From weight and span to a gait, and to what the motor must give.",steps:[{name:"weight",title:"Start from the weight",flight:{...P,speed:"cheapest"},view:{camera:"front",arrows:!1},look:"picture",tell:({now:i,semiSpan:e})=>[`This ${i.title} has a mass of ${te(i,"mass")} and two wings of ${je(e)} each.`,"Over a beat, the wings must carry the weight and balance the drag.","At the end of the beat the body must have the attitude and the velocities that it began with."]},{name:"gait",title:"Find a gait that closes",flight:{...P,speed:"cheapest"},view:{camera:"side",arrows:!0},look:"picture",tell:({now:i})=>[`The solver looks for a wingbeat that repeats itself. It beats at ${A(i.frequency)} ${y(i)}.`,...De(i),"Arrows show the air load on each strip of the wing."]},{name:"motor",title:"What the motor must give",flight:{...P,speed:"cheapest"},view:{camera:"side",arrows:!0},look:"gauges",tell:({now:i})=>[`The hinges of the wings need ${v(i.power)}: the mean over a beat, braking not counted.`,`That is ${v(i.power/i.mass)} for each kilogram of the robot.`,"Gears and motor lose some of what they draw, so the battery must give more."]},{name:"slow",title:"Slow flight",flight:{...P,speed:"slowest"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:i,seen:e})=>[`The slowest flight computed here, ${y(i)}, needs ${v(i.power)}.`,...k(e.gait,t=>`Against the cheapest flight the frequency ${$(t.frequency,i.frequency,A)}.`)]},{name:"fast",title:"Fast flight",flight:{...P,speed:"fastest"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:i,seen:e})=>[`${M(y(i))} it needs ${v(i.power)}.`,...k(e.gait,({power:t})=>`A motor sized for the cheapest flight, with ${v(t)}, ${Ue(t,i.power)}.`),"For a robot of your own, write its numbers into a species file and drop it on this page."]}]},V={animal:"pigeon",model:["paper","animal"],speed:"pushed"},Ve={direction:"tail",feedback:!1},Ke={name:"tumbling",title:"Why it tumbles",teaser:"One gust, first with a fixed wingbeat, then with feedback.",steps:[{name:"orbit",title:"A flight that repeats itself",flight:V,view:{camera:"side",arrows:!1},look:"picture",tell:({now:i})=>[`${M(y(i))} the pigeon flies a beat that ends as it began. Undisturbed, it would go on for ever.`,...He(i)]},{name:"free",title:"A gust, and a wingbeat that does not react",flight:V,view:{camera:"side",arrows:!1},push:Ve,look:"picture",tell:({push:i})=>[`The pigeon meets ${H(i)}. Its wings go on beating as before.`,`It is ${i.outcome}.`]},{name:"held",title:"The same gust, with feedback",flight:V,view:{camera:"side",arrows:!1},push:{...Ve,feedback:!0},look:"picture",tell:({push:i})=>[`Again ${H(i)}. Now feedback sees attitude and velocities once in each beat, and changes the wingbeat.`,`It is ${i.outcome}.`]},{name:"again",title:"Push it yourself",flight:V,view:{camera:"side",arrows:!1},push:{direction:"upward",feedback:!1},look:"picture",tell:({push:i})=>[`Now ${H(i)}, again without feedback. The pigeon is ${i.outcome}.`,"Below the picture you can choose the gust yourself.","The feedback follows from the equations of motion; how birds do it is not modelled."]}]};var Xe={name:"hovering",title:"Why hovering costs",teaser:"A hummingbird slows down, and its power rises.",steps:[{name:"cheap",title:"The cheapest flight",flight:{animal:"annas-hummingbird",model:"animal",speed:"cheapest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i})=>[`Of the speeds computed here, this hummingbird needs the least power ${y(i)}: ${v(i.power)}.`,"To stay up it must push air down. The downwash tilts the air loads back, and that costs induced power.",`It is ${v(i.spent.induced)} here, ${Ie(Fe(i,"induced"))} of what is spent on the air.`]},{name:"slow",title:"Slower, with less air to push",flight:{animal:"annas-hummingbird",model:"animal",speed:"slow"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i,seen:e})=>[`${M(y(i))} less air passes the wings in each second, and all of it must go down faster.`,...k(e.cheap,t=>`Induced power ${$(t.spent.induced,i.spent.induced)}.`)]},{name:"hover",title:"No wind but its own",flight:{animal:"annas-hummingbird",model:"animal",speed:"slowest"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:i,seen:e})=>[`${M(y(i))} the bird beats at ${A(i.frequency)}.`,...i.speed?[]:["What moves the air past its wings is their beat alone."],...k(e.cheap,t=>`Against the cheapest flight, power ${$(t.power,i.power)}.`),`Of what is spent on the air, the largest part is ${We(i)}.`]},{name:"fast",title:"Fast flight",flight:{animal:"annas-hummingbird",model:"animal",speed:"fastest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i,seen:e})=>[`${M(y(i))} air is plentiful, but it drags on body and wings.`,...k(e.hover,t=>`Against the slowest flight, induced power ${$(t.spent.induced,i.spent.induced)}.`),...k(e.hover,t=>`The power against the drag of body and tail ${$(t.spent.parasite,i.spent.parasite)}.`)]},{name:"muscle",title:"Can its muscle do it?",flight:{animal:"annas-hummingbird",model:"animal",speed:"slowest"},view:{camera:"front",arrows:!1},look:"gauges",tell:({now:i})=>[`Back ${y(i)}. Power per mass is ${_e(se(i,"positive_power_per_mass"))}.`,"The bars show where the other numbers lie. Now drag the point yourself."]}]},ie={animal:"bat",model:"paper",speed:"cheapest"},Ye={...ie,model:"dickinson"},Qe={name:"coefficients",title:"A plate against a fruit fly",teaser:"The same bat in the same air; only the measured wing differs.",steps:[{name:"plate",title:"A bat on flat plates",flight:ie,view:{camera:"oblique",arrows:!0},look:"picture",tell:({now:i})=>["The forces of the air were measured once, on another wing. The model uses them for every strip of this one.","Here it was a flat plate (Su et al. 2023).",`So the bat beats at ${A(i.frequency)} and needs ${v(i.power)} ${y(i)}.`]},{name:"fly",title:"The same bat, a fruit fly's wing",flight:Ye,speedOf:"plate",view:{camera:"oblique",arrows:!0},pin:"plate",look:"picture",tell:({now:i,seen:e})=>["The coefficients now come from a model of a fruit fly's wing in oil (Dickinson et al. 1999).",...k(e.plate,()=>"Animal and speed are the same; the ghost in the picture flies on plates."),...k(e.plate,t=>`The frequency ${$(t.frequency,i.frequency,A)}.`),...k(e.plate,t=>`Power ${$(t.power,i.power)}.`)]},{name:"fast",title:"Faster, on plates",flight:{...ie,speed:"fastest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:i,seen:e})=>[`${M(y(i))}, on plates again, the bat needs ${v(i.power)}.`,...k(e.plate,t=>`The frequency ${$(t.frequency,i.frequency,A)}.`)]},{name:"fastFly",title:"Faster, with the fruit fly's wing",flight:{...Ye,speed:"fastest"},speedOf:"fast",view:{camera:"side",arrows:!0},pin:"fast",look:"curve",tell:({now:i,seen:e})=>[...k(e.fast,t=>`With the fruit fly's coefficients, power ${$(t.power,i.power)} ${y(i)}.`),"Neither wing is a bat's. The two answers show how much a result depends on that choice."]}]};var Ze=[Xe,Qe,Ge,Ke],et={slowest:i=>i[0].speed,fastest:i=>i.at(-1).speed,cheapest:i=>Je(i).speed,slow:i=>Ft(i,.75*i[0].speed+.25*Je(i).speed).speed};function Je(i){return i.reduce((e,t)=>t.power<e.power?t:e)}function Ft(i,e){return i.reduce((t,s)=>Math.abs(s.speed-e)<Math.abs(t.speed-e)?s:t)}var Bt=6,G=class{constructor(e){this.face=e,this.calm=window.matchMedia("(prefers-reduced-motion: reduce)").matches,this.cards=Ze.map(s=>this.card(s));let t=r("ul",{},...this.cards.map(({element:s})=>s));this.element=r("section",{class:"wbx-tours"},r("h2",{},"Guided tours"),t),this.build()}card(e){let t=r("button",{type:"button",onclick:()=>this.start(e,t)},e.title),s=r("span");return{story:e,button:t,words:s,element:r("li",{},t,s)}}offer(){for(let{story:e,button:t,words:s}of this.cards)t.disabled=!e.steps.some(n=>this.flight(n)),s.textContent=t.disabled?"This page has no flight of this tour.":e.teaser}build(){let e=(s,n,o={})=>r("button",{type:"button",onclick:n,...o},s);this.count=r("p",{class:"wbx-hint"}),this.title=r("h2",{tabindex:"-1"}),this.text=r("div",{class:"wbx-tour-text","aria-live":"polite"}),this.back=e("Back",()=>this.go(this.nth-1,-1)),this.again=e("Show this step again",()=>this.go(this.nth,1),{hidden:!0}),this.next=e("Next",()=>this.isLast?this.close():this.go(this.nth+1,1),{"data-go":"next"});let t=e("\xD7",()=>this.close(),{class:"wbx-close","aria-label":"Close the tour"});this.panel=r("section",{class:"wbx-tour","aria-label":"Guided tour",hidden:!0,onkeydown:s=>this.key(s)},r("div",{class:"wbx-row"},this.count,t),this.title,this.text,r("div",{class:"wbx-row"},this.back,this.again,this.next))}key(e){if(e.ctrlKey||e.metaKey||e.altKey)return;let t={ArrowRight:this.next,ArrowLeft:this.back}[e.key];if(e.key==="Escape")this.close();else if(t&&!t.disabled)t.click();else return;e.preventDefault(),e.stopPropagation()}start(e,t){this.before??=this.found(),Object.assign(this,{story:e,opener:t,seen:{}}),this.panel.hidden=!1,this.face.root.dataset.tour=e.name,this.title.focus({preventScroll:!0}),this.go(0,1)}found(){let{viewer:e,pins:t}=this.face;return{view:e&&he(e),pinned:t.answer,ghost:t.ghost}}close(){let{viewer:e,pins:t}=this.face;this.pin(void 0),t.ghost!==this.before.ghost&&t.turn(),e&&this.before.view&&re(e,this.before.view),this.before=void 0,this.panel.hidden=!0,this.step=void 0,delete this.face.root.dataset.tour,delete this.face.root.dataset.look,this.opener.focus()}flight({flight:e}){let t=e.speed==="pushed",s=[e.model].flat().find(n=>this.face.has({animal:e.animal,model:n,push:t}));return s&&{...e,model:s}}go(e,t){let{steps:s}=this.story,n=[],o=e;for(;s[o]&&!this.flight(s[o]);o+=t)n.push(s[o].title);let a=s.slice(o+1),h=!a.some(l=>this.flight(l));h&&n.push(...a.map(({title:l})=>l)),this.left=n.map(l=>`Left out, because this page has no such flight: \u201C${l}\u201D.`),Object.assign(this,{nth:o,step:s[o],ready:!1,tries:0,isLast:h}),this.count.textContent=`${this.story.title}: ${o+1} of ${s.length}`,this.title.textContent=this.step.title,this.back.disabled=!s.slice(0,o).some(l=>this.flight(l)),this.next.textContent=this.isLast?"Finish":"Next",this.again.hidden=!0,this.say(["Looking for this flight \u2026"]),this.ask()}heard(){this.step&&(this.ready?this.again.hidden=Wt(this.face.answer,this.shown):this.ask())}heardCurve(){this.step&&this.waitsForCurve&&!this.face.answer.provisional&&this.ask()}ask(){let{face:e,step:t}=this,{animal:s,model:n}=this.flight(t),{answer:o}=e;if(o?.species!==s||o.model!==n)return this.request({animal:s,model:n});let{pending:a=[],points:h}=e.curve.data;if(this.waitsForCurve=a.length>0,this.waitsForCurve)return this.say([`Computing the curve; ${a.length} more speeds to go.`]);let l=this.speed(h.filter(d=>d.certified));if(l!==void 0&&Math.abs(l-o.speed)>1e-9)return this.request({speed:l});if(t.push&&!o.scene?.pushes&&o.status==="converged")return this.say(["Flying through the gusts \u2026"]),e.onpush();this.arrive(o)}request(e){this.tries+=1,this.tries>Bt?this.finish(["This page does not have the flight of this step."]):this.face.ask(e)}speed(e){let{step:t,seen:s,face:n}=this;return t.flight.speed==="pushed"?n.pushSpeed(n.answer):s[t.speedOf]?s[t.speedOf].speed:e.length?et[t.flight.speed](e):void 0}arrive(e){let{step:t,seen:s}=this;if(this.ready=!0,e.status==="converged"&&(s[t.name]=e),this.pin(s[t.pin]),this.look(),t.push||this.face.viewer?.pushes.reset(),e.status!=="converged")return this.finish([e.sentence]);let n=t.push&&this.push(e.scene.pushes);if(t.push&&!n)return this.finish(["No feedback was found that holds this flight."]);this.finish(t.tell({now:e,seen:s,push:n,semiSpan:e.scene.flights[0].semi_span}))}finish(e){this.ready=!0,this.shown=this.face.answer,this.say(e)}say(e){let t=this.left.map(s=>r("p",{class:"wbx-hint"},s));this.text.replaceChildren(...t,...e.map(s=>r("p",{},...Be(s))))}pin(e){let{pins:t}=this.face,s=this.pinned&&t.answer===this.pinned,n=e??(s?this.before.pinned:t.answer);n!==t.answer&&t.pin(n),this.pinned=e}push(e){let{direction:t,feedback:s}=this.step.push,n=e.find(o=>o.direction===t&&o.feedback===s);return n&&this.face.viewer.pushes.choose(n),n}look(){let{viewer:e,root:t}=this.face;if(!e)return;let{camera:s,arrows:n}=this.step.view,o={resultant:n,lift:!1,drag:!1,trails:!0};e.setCamera(s);for(let h of e.root.querySelectorAll(".wb-toggle")){let l=h.querySelector("input"),d=o[h.textContent.trim()];d!==void 0&&l.checked!==d&&l.click()}t.dataset.look=this.step.look;let a=this.step.look==="picture"?e.picture:t.querySelector(`[data-part="${this.step.look}"]`);this.scroll(t,a)}scroll(e,t){let s=this.calm?"auto":"smooth",n=this.panel.offsetWidth<window.innerWidth?0:this.panel.offsetHeight;t.getBoundingClientRect().bottom-e.getBoundingClientRect().top<=window.innerHeight-n?e.scrollIntoView({block:"start",behavior:s}):t.scrollIntoView({block:"end",behavior:s})}};function Wt(i,e){return["species","model","speed"].every(t=>i[t]===e[t])}var _t={closes:["Closes","Does not close"],plausible:["Plausible","Not plausible"]},jt=/(?<![\w.])(\d[\d.,]*(?:e[+-]?\d+)?(?: m\/s| W| times a second| times)?)/,K=class{constructor(){this.sentence=r("h1",{class:"wbx-sentence"}),this.lights=r("ul",{class:"wbx-lights","aria-label":"Verdict"}),this.summary=r("summary"),this.list=r("ul",{tabindex:"0","aria-label":"Warnings"}),this.warnings=r("details",{class:"wbx-warnings"},this.summary,this.list),this.warnings.open=window.matchMedia("(min-width: 900px)").matches,this.warnings.hidden=!0,this.element=r("div",{class:"wbx-verdict"},this.lights,this.warnings),this.spoken=r("p",{class:"wbx-unseen",role:"status"})}show(e){let t=e.sentence.split(jt);this.sentence.replaceChildren(...t.map((a,h)=>h%2?r("b",{},a):a)),this.speak(e.sentence),this.lights.replaceChildren(...e.lights.map(a=>this.light(a)));let{warnings:s}=e;this.warnings.hidden=!1,this.warnings.classList.toggle("wbx-narrow",!s.length),e.status!=="converged"&&(this.warnings.open=!0);let n=s.length===1?"1 warning":`${s.length} warnings`;this.summary.replaceChildren(r("span",{class:"wbx-narrow"},"Reasons, "),n);let o=e.lights.map(({text:a})=>r("li",{class:"wbx-narrow"},a));this.list.replaceChildren(...o,...s.map(a=>r("li",{},a)))}speak(e){clearTimeout(this.later),this.later=setTimeout(()=>this.spoken.textContent=e,700)}light({name:e,good:t,known:s,text:n}){let o=t?"good":s===!1?"open":"bad",a=o==="open"?"Plausible? Not known":_t[e][t?0:1],h=r("span",{class:"wbx-sign","aria-hidden":"true"},{good:"\u2713",bad:"!",open:"?"}[o]),l=r("span",{},r("strong",{},a)," ",r("span",{class:"wbx-why"},n));return r("li",{class:`wbx-light wbx-${o}`,"data-light":e},h,l)}};var Dt="the closest wingbeat: it does not fly",Ut=0,L=class{constructor(e,{theme:t="system",snap:s=!0}={}){this.onask=()=>{},this.onpush=void 0,this.onfile=void 0,this.onpushed=()=>{},this.theme=t,this.id=`wbx${++Ut}`,this.verdict=new K,this.curve=new B(n=>this.ask({speed:n}),s),this.gauges=new W,this.pins=new U(()=>this.show()),this.tour=new G(this),this.linked=new _(this),this.own=new D(this),this.root=r("section",{class:"wbx","aria-label":"Explorer"},r("style",{},Re)),this.root.face=this,this.build(),this.setTheme(t),e.append(this.root)}build(){this.animal=this.choice("Animal",o=>this.ask({animal:o})),this.model=this.choice("Model",o=>this.ask({model:o})),this.choices=r("div",{class:"wbx-choices"},this.animal.element,this.model.element),this.state=r("p",{class:"wbx-state",role:"status"}),this.picture=r("div",{class:"wbx-picture"}),this.pushButton=r("button",{type:"button",class:"wbx-push",hidden:!0,onclick:()=>this.push()}),this.numbers=r("tbody");let e=r("table",{},this.numbers),t=r("details",{class:"wbx-more"},r("summary",{},"More numbers"),e),s=[r("h2",{},"Is this flight plausible?"),this.gauges.element,this.pins.element,t],n=r("div",{class:"wbx-judged","data-part":"gauges"},...s);this.root.append(r("header",{class:"wbx-say"},this.choices,this.verdict.sentence,this.verdict.spoken),r("div",{class:"wbx-side"},this.verdict.element,n),r("div",{class:"wbx-stage"},this.picture,this.pushButton,this.state,this.curve.element),r("div",{class:"wbx-extras"},this.tour.element,this.own.element),this.tour.panel)}choice(e,t){let s=`${this.id}-${e}`,n=r("select",{id:s,onchange:()=>t(n.value)});return{select:n,element:r("span",{class:"wbx-choice"},r("label",{for:s},e),n)}}setChoices({animals:e,models:t},{animal:s,model:n}){this.asked={speed:this.asked?.speed,animal:s,model:n};for(let[{select:o},a,h]of[[this.animal,e,s],[this.model,t,n]])o.replaceChildren(...a.map(({name:l,title:d})=>r("option",{value:l},d))),o.value=h;this.tour.offer()}showCurve(e){this.curve.show(e),this.tour.heardCurve()}showAnswer(e){this.answer=e,this.asked={animal:e.species,model:e.model,speed:e.speed},this.animal.select.value=e.species,this.model.select.value=e.model,this.pins.now(e),this.say(""),this.show(),this.pushing&&this.pushSpeed(e)===e.speed?this.push():this.linked.heard(),e.provisional||queueMicrotask(()=>this.tour.heard())}showPushes(e){let t=document.activeElement===this.pushButton;this.showAnswer({...this.answer,scene:{...this.answer.scene,pushes:e}}),t&&this.viewer.pushes.element.querySelector("select")?.focus()}showBetween(e){let{answer:t}=this;!t?.scene||this.pins.answer||(this.fly(e?{...t.scene,flights:[e]}:t.scene,t.species),this.label(t,e?.summary))}compare(e){this.pins.pin(e)}say(e){this.state.textContent=e}setTheme(e){this.theme=e,this.root.dataset.theme=e,this.viewer?.setTheme(e)}has({animal:e,model:t,push:s}){let n=({select:o},a)=>[...o.options].some(h=>h.value===a);return n(this.animal,e)&&n(this.model,t)&&!(s&&!this.onpush)}pushSpeed(e){return this.onpush&&e.status==="converged"?e.speed:void 0}ask(e){this.asked={...this.asked,...e},this.linked.want(""),this.onask({...this.asked})}push(){let e=this.pushSpeed(this.answer);this.pushing=e!==this.answer.speed,this.pushing?this.ask({speed:e}):this.onpush()}tellPush(){let{answer:e}=this,t=this.pushSpeed(e);if(this.pushButton.hidden=t===void 0||!!e.scene?.pushes,t===void 0)return;let s=t===e.speed?"":`, at ${g(t)} m/s`;this.pushButton.textContent=`Push it with a gust${s}`}show(){let{answer:e}=this;if(!e)return;let t=this.pins.answer;this.root.dataset.status=e.status,this.verdict.show(e),this.gauges.show(e.gauges,t?.gauges),this.curve.mark(e.speed),this.curve.pin(t?.status==="converged"?t:void 0),this.numbers.replaceChildren(...Ht(e,t)),this.picture.hidden=!e.scene,e.scene&&this.fly(this.pins.scene(e),e.species),this.label(e),e.scene||this.say("This flight tumbles before there is anything to show."),this.tellPush()}label({status:e},t=""){this.viewer&&(this.viewer.warning.textContent=e==="converged"?t:Dt,this.viewer.warning.classList.toggle("wbx-between",t!==""))}fly(e,t){let s=e.flights.length;if(this.blind)return;let n=t===this.whose&&s===this.count&&this.viewer?.ghost===this.pins.ghost;if(this.viewer)this.replace(e,n);else{try{this.viewer=new oe(this.picture,e,{theme:this.theme,compact:!0})}catch{this.blind=!0,this.picture.replaceChildren(r("p",{},"This browser cannot draw in three dimensions: WebGL is missing or switched off.")),this.own.show();return}this.own.show(),this.viewer.pushes.onchange=()=>this.onpushed()}t!==this.whose&&this.viewer.setBeat(1),[this.whose,this.count]=[t,s]}replace(e,t){let{camera:s,controls:n}=this.viewer.stage,[o,a]=[s.position.clone(),n.target.clone()];this.viewer.ghost=this.pins.ghost,this.viewer.replace(e),t&&(s.position.copy(o),n.target.copy(a),n.update())}destroy(){this.own.destroy(),this.curve.destroy(),this.viewer?.destroy(),this.root.remove()}};function Ht(i,e){let t=new Map((e?.numbers??[]).map(([o,a])=>[o,a])),s=i.numbers.map(([o,a,h])=>{let l=[r("td",{},a),...e?[r("td",{},t.get(o)??"\u2013")]:[]];return r("tr",{},r("th",{scope:"row"},o),...l,r("td",{},h))});if(!e)return s;let n=["","now","pinned",""].map(o=>r("th",{scope:"col"},o));return[r("tr",{},...n),...s]}var Vt=.5,Y=class{constructor(e){this.answers=e,this.flights=new Map}at(e){let t=this.answers.findIndex(d=>d.speed>=e),[s,n]=[this.answers[t-1],this.answers[t]];if(!s||!n||n.speed===e||!tt(s)||!tt(n))return;let[o,a]=[this.flight(s),this.flight(n)];if(!Gt(o,a))return;let h=(e-s.speed)/(n.speed-s.speed),l=`Picture between the wingbeats at ${g(s.speed)} and ${g(n.speed)} m/s`;return{...Kt(o,a,h),summary:l}}flight(e){return this.flights.has(e)||this.flights.set(e,new ae(e.scene.flights[0])),this.flights.get(e)}},tt=({status:i,scene:e})=>i==="converged"&&e;function Gt(i,e){let[t,s]=[i.arrays.corners,e.arrays.corners];if(i.samples!==e.samples||t.length!==s.length)return!1;let n=(Vt*i.semi_span)**2;for(let o=0;o<t.length;o+=3)if([0,1,2].reduce((h,l)=>h+(s[o+l]-t[o+l])**2,0)>n)return!1;return!0}function Kt(i,e,t){let s=t<.5?i:e,n={};for(let o of Object.keys(s.arrays)){let[a,h]=[i.arrays[o],e.arrays[o]],l=a?.length===h?.length;n[o]=l?a.map((d,p)=>d+t*(h[p]-d)):s.arrays[o]}return{...s,arrays:n,frequency:i.frequency+t*(e.frequency-i.frequency)}}var X=class{constructor(e,t){this.catalogue=t,this.lattices=new Map,this.pushes=new Map,this.asked=t.start,this.face=new L(e,{}),this.face.onask=s=>this.ask(s),this.face.curve.onslide=s=>this.slide(s),this.face.onpush=()=>this.push(),this.face.onpushed=()=>this.link(),this.face.has=({animal:s,model:n,push:o})=>t.files.includes(R(s,n,o)),this.face.pushSpeed=({species:s,model:n})=>this.pushSpeed(s,n),window.addEventListener("hashchange",()=>this.follow()),this.follow()}follow(){let e=this.fragment();this.asked=Yt(this.asked,e),this.face.linked.want(e.push??""),this.ask(this.asked)}fragment(){let e=new URLSearchParams(location.hash.slice(1)),t={};return this.catalogue.animals.some(({name:s})=>s===e.get("animal"))&&(t.animal=e.get("animal")),this.catalogue.models.some(({name:s})=>s===e.get("model"))&&(t.model=e.get("model")),Number.isFinite(parseFloat(e.get("speed")))&&(t.speed=parseFloat(e.get("speed"))),e.get("push")&&(t.push=e.get("push")),t}models(e){return this.catalogue.models.filter(({name:t})=>this.catalogue.files.includes(R(e,t)))}ask(e){let t=this.models(e.animal),s=t.some(({name:o})=>o===e.model)?e.model:t[0].name,n=e.animal===this.asked.animal?e.speed:void 0;this.asked={...e,model:s,speed:n},this.listed!==e.animal&&this.face.setChoices({animals:this.catalogue.animals,models:t},this.asked),this.listed=e.animal,this.load()}load(){let{asked:e}=this,t=`${e.animal}/${e.model}`;if(this.lattices.has(t))return this.show(this.lattices.get(t));this.face.say("Loading \u2026"),this.read(R(e.animal,e.model))}read(e){let t=()=>this.face.say(`The file data/${e} could not be read.`);document.head.append(r("script",{src:`data/${e}`,onerror:t}))}async hold(e,t,s){let n=await this.decompressed(s);if(n){for(let{gauges:o}of n.answers)for(let a of o)a.source??=n.sources[a.name];this.lattices.set(`${e}/${t}`,n),this.asked.animal===e&&this.asked.model===t&&this.show(n)}}pushSpeed(e,t){let s=this.lattices.get(`${e}/${t}`);return this.catalogue.files.includes(R(e,t,!0))?s?.speed:void 0}push(){let{animal:e,model:t}=this.asked,s=this.pushes.get(`${e}/${t}`);if(s)return this.face.showPushes(s);this.face.say("Loading the gusts \u2026"),this.read(R(e,t,!0))}async holdPushes(e,t,s){let n=await this.decompressed(s);if(!n)return;this.pushes.set(`${e}/${t}`,n);let{asked:o}=this;o.animal===e&&o.model===t&&o.speed===this.pushSpeed(e,t)&&this.face.showPushes(n)}async decompressed(e){try{return await Xt(e)}catch{this.face.say("This browser cannot unpack the data; a newer one can.");return}}show(e){let t=({speed:n})=>Math.abs(n-(this.asked.speed??e.speed)),s=e.answers.reduce((n,o)=>t(o)<t(n)?o:n);this.shown!==e&&(this.face.showCurve(e.curve),this.between=new Y(e.answers)),this.shown=e,this.asked.speed=s.speed,this.face.showAnswer(s),this.link()}slide(e){this.sliding=e,this.due??=requestAnimationFrame(()=>{this.due=void 0;let t=this.sliding===void 0?void 0:this.between?.at(this.sliding);(t||this.isBetween)&&this.face.showBetween(t),this.isBetween=!!t})}link(){let{animal:e,model:t,speed:s}=this.asked,n=this.face.linked.name;history.replaceState(null,"",`#${new URLSearchParams({animal:e,model:t,speed:s,...n&&{push:n}})}`)}};function Yt(i,{animal:e,model:t,speed:s}){return{...e?{animal:e,speed:s}:{animal:i.animal,speed:s??i.speed},model:t??i.model}}async function Xt(i){let e=Uint8Array.from(atob(i),s=>s.charCodeAt(0)),t=new Blob([e]).stream().pipeThrough(new DecompressionStream("gzip"));return JSON.parse(await new Response(t).text())}function R(i,e,t=!1){return`${i}-${e}${t?"-pushes":""}.js`}var ne;globalThis.wingbeatExplorer={explore:(i,e={})=>new L(i,e),mount:le,open:i=>ne=new X(document.querySelector("main"),i),hold:(i,e,t)=>ne.hold(i,e,t),holdPushes:(i,e,t)=>ne.holdPushes(i,e,t)};})();
