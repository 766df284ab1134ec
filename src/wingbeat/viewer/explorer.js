// wingbeat explorer, made by viewer/build.mjs; sources sha256:ae9f3ab505ab0c7886c9c35dfd4c1e4e7631265001506029becd55b6f465c611
(()=>{var Qp=Object.create;var Yh=Object.defineProperty;var tm=Object.getOwnPropertyDescriptor;var em=Object.getOwnPropertyNames;var im=Object.getPrototypeOf,nm=Object.prototype.hasOwnProperty;var sm=(n,t)=>()=>{try{return t||n((t={exports:{}}).exports,t),t.exports}catch(e){throw t=0,e}};var rm=(n,t,e,i)=>{if(t&&typeof t=="object"||typeof t=="function")for(let s of em(t))!nm.call(n,s)&&s!==e&&Yh(n,s,{get:()=>t[s],enumerable:!(i=tm(t,s))||i.enumerable});return n};var om=(n,t,e)=>(e=n!=null?Qp(im(n)):{},rm(t||!n||!n.__esModule?Yh(e,"default",{value:n,enumerable:!0}):e,n));var Jf=sm(Ah=>{var Hf=Object.defineProperty,pb=n=>Hf(n,"__esModule",{value:!0}),mb=(n,t)=>{for(var e in t)Hf(n,e,{get:t[e],enumerable:!0})};pb(Ah);mb(Ah,{GIFEncoder:()=>Yf,applyPalette:()=>Sb,default:()=>Nb,nearestColor:()=>Rb,nearestColorIndex:()=>qf,nearestColorIndexWithDistance:()=>$f,prequantize:()=>Mb,quantize:()=>bb,snapColorsToPalette:()=>Ab});var gb={signature:"GIF",version:"89a",trailer:59,extensionIntroducer:33,applicationExtensionLabel:255,graphicControlExtensionLabel:249,imageSeparator:44,signatureSize:3,versionSize:3,globalColorTableFlagMask:128,colorResolutionMask:112,sortFlagMask:8,globalColorTableSizeMask:7,applicationIdentifierSize:8,applicationAuthCodeSize:3,disposalMethodMask:28,userInputFlagMask:2,transparentColorFlagMask:1,localColorTableFlagMask:128,interlaceFlagMask:64,idSortFlagMask:32,localColorTableSizeMask:7};function Gf(n=256){let t=0,e=new Uint8Array(n);return{get buffer(){return e.buffer},reset(){t=0},bytesView(){return e.subarray(0,t)},bytes(){return e.slice(0,t)},writeByte(s){i(t+1),e[t]=s,t++},writeBytes(s,r=0,o=s.length){i(t+o);for(let a=0;a<o;a++)e[t++]=s[a+r]},writeBytesView(s,r=0,o=s.byteLength){i(t+o),e.set(s.subarray(r,r+o),t),t+=o}};function i(s){var r=e.length;if(r>=s)return;var o=1024*1024;s=Math.max(s,r*(r<o?2:1.125)>>>0),r!=0&&(s=Math.max(s,256));let a=e;e=new Uint8Array(s),t>0&&e.set(a.subarray(0,t),0)}}var Sh=12,Bf=5003,xb=[0,1,3,7,15,31,63,127,255,511,1023,2047,4095,8191,16383,32767,65535];function _b(n,t,e,i,s=Gf(512),r=new Uint8Array(256),o=new Int32Array(Bf),a=new Int32Array(Bf)){let l=o.length,c=Math.max(2,i);r.fill(0),a.fill(0),o.fill(-1);let h=0,u=0,d=c+1,f=d,p=!1,_=f,g=(1<<_)-1,m=1<<d-1,b=m+1,S=m+2,w=0,E=e[0],T=0;for(let D=l;D<65536;D*=2)++T;T=8-T,s.writeByte(c),M(m);let x=e.length;for(let D=1;D<x;D++)t:{let P=e[D],U=(P<<Sh)+E,F=P<<T^E;if(o[F]===U){E=a[F];break t}let W=F===0?1:l-F;for(;o[F]>=0;)if(F-=W,F<0&&(F+=l),o[F]===U){E=a[F];break t}M(E),E=P,S<1<<Sh?(a[F]=S++,o[F]=U):(o.fill(-1),S=m+2,p=!0,M(m))}return M(E),M(b),s.writeByte(0),s.bytesView();function M(D){for(h&=xb[u],u>0?h|=D<<u:h=D,u+=_;u>=8;)r[w++]=h&255,w>=254&&(s.writeByte(w),s.writeBytesView(r,0,w),w=0),h>>=8,u-=8;if((S>g||p)&&(p?(_=f,g=(1<<_)-1,p=!1):(++_,g=_===Sh?1<<_:(1<<_)-1)),D==b){for(;u>0;)r[w++]=h&255,w>=254&&(s.writeByte(w),s.writeBytesView(r,0,w),w=0),h>>=8,u-=8;w>0&&(s.writeByte(w),s.writeBytesView(r,0,w),w=0)}}}var yb=_b;function Vf(n,t,e){return n<<8&63488|t<<2&992|e>>3}function Wf(n,t,e,i){return n>>4|t&240|(e&240)<<4|(i&240)<<8}function Xf(n,t,e){return n>>4<<8|t&240|e>>4}function Tl(n,t,e){return n<t?t:n>e?e:n}function Xr(n){return n*n}function kf(n,t,e){var i=0,s=1e100;let r=n[t],o=r.cnt,a=r.ac,l=r.rc,c=r.gc,h=r.bc;for(var u=r.fw;u!=0;u=n[u].fw){let f=n[u],p=f.cnt,_=o*p/(o+p);if(!(_>=s)){var d=0;e&&(d+=_*Xr(f.ac-a),d>=s)||(d+=_*Xr(f.rc-l),!(d>=s)&&(d+=_*Xr(f.gc-c),!(d>=s)&&(d+=_*Xr(f.bc-h),!(d>=s)&&(s=d,i=u))))}}r.err=s,r.nn=i}function Eh(){return{ac:0,rc:0,gc:0,bc:0,cnt:0,nn:0,fw:0,bk:0,tm:0,mtm:0,err:0}}function vb(n,t){let e=t==="rgb444"?4096:65536,i=new Array(e),s=n.length;if(t==="rgba4444")for(let r=0;r<s;++r){let o=n[r],a=o>>24&255,l=o>>16&255,c=o>>8&255,h=o&255,u=Wf(h,c,l,a),d=u in i?i[u]:i[u]=Eh();d.rc+=h,d.gc+=c,d.bc+=l,d.ac+=a,d.cnt++}else if(t==="rgb444")for(let r=0;r<s;++r){let o=n[r],a=o>>16&255,l=o>>8&255,c=o&255,h=Xf(c,l,a),u=h in i?i[h]:i[h]=Eh();u.rc+=c,u.gc+=l,u.bc+=a,u.cnt++}else for(let r=0;r<s;++r){let o=n[r],a=o>>16&255,l=o>>8&255,c=o&255,h=Vf(c,l,a),u=h in i?i[h]:i[h]=Eh();u.rc+=c,u.gc+=l,u.bc+=a,u.cnt++}return i}function bb(n,t,e={}){let{format:i="rgb565",clearAlpha:s=!0,clearAlphaColor:r=0,clearAlphaThreshold:o=0,oneBitAlpha:a=!1}=e;if(!n||!n.buffer)throw new Error("quantize() expected RGBA Uint8Array data");if(!(n instanceof Uint8Array)&&!(n instanceof Uint8ClampedArray))throw new Error("quantize() expected RGBA Uint8Array data");let l=new Uint32Array(n.buffer),c=e.useSqrt!==!1,h=i==="rgba4444",u=vb(l,i),d=u.length,f=d-1,p=new Uint32Array(d+1);for(var _=0,m=0;m<d;++m){let H=u[m];if(H!=null){var g=1/H.cnt;h&&(H.ac*=g),H.rc*=g,H.gc*=g,H.bc*=g,u[_++]=H}}Xr(t)/_<.022&&(c=!1);for(var m=0;m<_-1;++m)u[m].fw=m+1,u[m+1].bk=m,c&&(u[m].cnt=Math.sqrt(u[m].cnt));c&&(u[m].cnt=Math.sqrt(u[m].cnt));var b,S,w;for(m=0;m<_;++m){kf(u,m,!1);var E=u[m].err;for(S=++p[0];S>1&&(w=S>>1,!(u[b=p[w]].err<=E));S=w)p[S]=b;p[S]=m}var T=_-t;for(m=0;m<T;){for(var x;;){var M=p[1];if(x=u[M],x.tm>=x.mtm&&u[x.nn].mtm<=x.tm)break;x.mtm==f?M=p[1]=p[p[0]--]:(kf(u,M,!1),x.tm=m);var E=u[M].err;for(S=1;(w=S+S)<=p[0]&&(w<p[0]&&u[p[w]].err>u[p[w+1]].err&&w++,!(E<=u[b=p[w]].err));S=w)p[S]=b;p[S]=M}var D=u[x.nn],P=x.cnt,U=D.cnt,g=1/(P+U);h&&(x.ac=g*(P*x.ac+U*D.ac)),x.rc=g*(P*x.rc+U*D.rc),x.gc=g*(P*x.gc+U*D.gc),x.bc=g*(P*x.bc+U*D.bc),x.cnt+=D.cnt,x.mtm=++m,u[D.bk].fw=D.fw,u[D.fw].bk=D.bk,D.mtm=f}let F=[];var W=0;for(m=0;;++W){let I=Tl(Math.round(u[m].rc),0,255),H=Tl(Math.round(u[m].gc),0,255),$=Tl(Math.round(u[m].bc),0,255),G=255;h&&(G=Tl(Math.round(u[m].ac),0,255),a&&(G=G<=(typeof a=="number"?a:127)?0:255),s&&G<=o&&(I=H=$=r,G=0));let et=h?[I,H,$,G]:[I,H,$];if(wb(F,et)||F.push(et),(m=u[m].fw)==0)break}return F}function wb(n,t){for(let e=0;e<n.length;e++){let i=n[e],s=i[0]===t[0]&&i[1]===t[1]&&i[2]===t[2],r=i.length>=4&&t.length>=4?i[3]===t[3]:!0;if(s&&r)return!0}return!1}function Rl(n,t){var e=0,i;for(i=0;i<n.length;i++){let s=n[i]-t[i];e+=s*s}return e}function Al(n,t){return t>1?Math.round(n/t)*t:n}function Mb(n,{roundRGB:t=5,roundAlpha:e=10,oneBitAlpha:i=null}={}){let s=new Uint32Array(n.buffer);for(let r=0;r<s.length;r++){let o=s[r],a=o>>24&255,l=o>>16&255,c=o>>8&255,h=o&255;a=Al(a,e),i&&(a=a<=(typeof i=="number"?i:127)?0:255),h=Al(h,t),c=Al(c,t),l=Al(l,t),s[r]=a<<24|l<<16|c<<8|h<<0}}function Sb(n,t,e="rgb565"){if(!n||!n.buffer)throw new Error("quantize() expected RGBA Uint8Array data");if(!(n instanceof Uint8Array)&&!(n instanceof Uint8ClampedArray))throw new Error("quantize() expected RGBA Uint8Array data");if(t.length>256)throw new Error("applyPalette() only works with 256 colors or less");let i=new Uint32Array(n.buffer),s=i.length,r=e==="rgb444"?4096:65536,o=new Uint8Array(s),a=new Array(r),l=e==="rgba4444";if(e==="rgba4444")for(let c=0;c<s;c++){let h=i[c],u=h>>24&255,d=h>>16&255,f=h>>8&255,p=h&255,_=Wf(p,f,d,u),g=_ in a?a[_]:a[_]=Eb(p,f,d,u,t);o[c]=g}else{let c=e==="rgb444"?Xf:Vf;for(let h=0;h<s;h++){let u=i[h],d=u>>16&255,f=u>>8&255,p=u&255,_=c(p,f,d),g=_ in a?a[_]:a[_]=Tb(p,f,d,t);o[h]=g}}return o}function Eb(n,t,e,i,s){let r=0,o=1e100;for(let a=0;a<s.length;a++){let l=s[a],c=l[3],h=Kn(c-i);if(h>o)continue;let u=l[0];if(h+=Kn(u-n),h>o)continue;let d=l[1];if(h+=Kn(d-t),h>o)continue;let f=l[2];h+=Kn(f-e),!(h>o)&&(o=h,r=a)}return r}function Tb(n,t,e,i){let s=0,r=1e100;for(let o=0;o<i.length;o++){let a=i[o],l=a[0],c=Kn(l-n);if(c>r)continue;let h=a[1];if(c+=Kn(h-t),c>r)continue;let u=a[2];c+=Kn(u-e),!(c>r)&&(r=c,s=o)}return s}function Ab(n,t,e=5){if(!n.length||!t.length)return;let i=n.map(o=>o.slice(0,3)),s=e*e,r=n[0].length;for(let o=0;o<t.length;o++){let a=t[o];a.length<r?a=[a[0],a[1],a[2],255]:a.length>r?a=a.slice(0,3):a=a.slice();let l=$f(i,a.slice(0,3),Rl),c=l[0],h=l[1];h>0&&h<=s&&(n[c]=a)}}function Kn(n){return n*n}function qf(n,t,e=Rl){let i=1/0,s=-1;for(let r=0;r<n.length;r++){let o=n[r],a=e(t,o);a<i&&(i=a,s=r)}return s}function $f(n,t,e=Rl){let i=1/0,s=-1;for(let r=0;r<n.length;r++){let o=n[r],a=e(t,o);a<i&&(i=a,s=r)}return[s,i]}function Rb(n,t,e=Rl){return n[qf(n,t,e)]}function Yf(n={}){let{initialCapacity:t=4096,auto:e=!0}=n,i=Gf(t),s=5003,r=new Uint8Array(256),o=new Int32Array(s),a=new Int32Array(s),l=!1;return{reset(){i.reset(),l=!1},finish(){i.writeByte(gb.trailer)},bytes(){return i.bytes()},bytesView(){return i.bytesView()},get buffer(){return i.buffer},get stream(){return i},writeHeader:c,writeFrame(h,u,d,f={}){let{transparent:p=!1,transparentIndex:_=0,delay:g=0,palette:m=null,repeat:b=0,colorDepth:S=8,dispose:w=-1}=f,E=!1;if(e?l||(E=!0,c(),l=!0):E=!!f.first,u=Math.max(0,Math.floor(u)),d=Math.max(0,Math.floor(d)),E){if(!m)throw new Error("First frame must include a { palette } option");Pb(i,u,d,m,S),zf(i,m),b>=0&&Ib(i,b)}let T=Math.round(g/10);Cb(i,w,T,p,_);let x=!!m&&!E;Lb(i,u,d,x?m:null),x&&zf(i,m),Db(i,h,u,d,S,r,o,a)}};function c(){Zf(i,"GIF89a")}}function Cb(n,t,e,i,s){n.writeByte(33),n.writeByte(249),n.writeByte(4),s<0&&(s=0,i=!1);var r,o;i?(r=1,o=2):(r=0,o=0),t>=0&&(o=t&7),o<<=2,n.writeByte(0|o|0|r),Sn(n,e),n.writeByte(s||0),n.writeByte(0)}function Pb(n,t,e,i,s=8){let a=Th(i.length)-1,l=128|s-1<<4|0|a,c=0,h=0;Sn(n,t),Sn(n,e),n.writeBytes([l,c,h])}function Ib(n,t){n.writeByte(33),n.writeByte(255),n.writeByte(11),Zf(n,"NETSCAPE2.0"),n.writeByte(3),n.writeByte(1),Sn(n,t),n.writeByte(0)}function zf(n,t){let e=1<<Th(t.length);for(let i=0;i<e;i++){let s=[0,0,0];i<t.length&&(s=t[i]),n.writeByte(s[0]),n.writeByte(s[1]),n.writeByte(s[2])}}function Lb(n,t,e,i){if(n.writeByte(44),Sn(n,0),Sn(n,0),Sn(n,t),Sn(n,e),i){let o=Th(i.length)-1;n.writeByte(128|o)}else n.writeByte(0)}function Db(n,t,e,i,s=8,r,o,a){yb(e,i,t,s,n,r,o,a)}function Sn(n,t){n.writeByte(t&255),n.writeByte(t>>8&255)}function Zf(n,t){for(var e=0;e<t.length;e++)n.writeByte(t.charCodeAt(e))}function Th(n){return Math.max(Math.ceil(Math.log2(n)),1)}var Nb=Yf});var am="http://www.w3.org/2000/svg";function Zh(n,t,e){for(let[i,s]of Object.entries(t))i.startsWith("on")?n.addEventListener(i.slice(2),s):s===!0?n.setAttribute(i,""):s!==!1&&n.setAttribute(i,s);return n.append(...e),n}function R(n,t={},...e){return Zh(document.createElement(n),t,e)}function Et(n,t={},...e){return Zh(document.createElementNS(am,n),t,e)}var Jh=[[0,.07,.38],[.02,.33,.59],[.43,.66,.8],[.93,.91,.89],[.85,.6,.45],[.7,.28,.07],[.35,0,.03]],Kh=[[.42,.35,.8],[.65,.27,.73],[.85,.3,.55],[.95,.45,.32],[.98,.66,.15]],Kr={lift:"#0072B2",drag:"#E69F00",force:"#009E73"};function jh(n,t){let e=t*(n.length-1),i=Math.min(Math.floor(e),n.length-2);return n[i].map((s,r)=>s+(e-i)*(n[i+1][r]-s))}function jr(n,t){return jh(Jh,(Math.min(Math.max(n/t,-1),1)+1)*.5)}function Qh(n){return jh(Kh,Math.min(Math.max(n,0),1))}function tu(n){return`linear-gradient(to right, ${n.map(e=>`rgb(${e.map(i=>Math.round(255*i)).join(" ")})`).join(", ")})`}var eu=()=>tu(Jh),iu=()=>tu(Kh);function Qr(n){let[t,e,i]=n.match(/[\d.]+/g).map(Number);return .3*t+.6*e+.1*i>127?"dark":"light"}function nn(n,t=[1,2,5,10]){let e=10**Math.floor(Math.log10(n));return t.map(i=>i*e).find(i=>i>=n*(1-1e-9))}function Pi(n){return Number(n.toPrecision(3)).toString()}var lm={f4:Float32Array,f8:Float64Array};function cm({kind:n,data:t,scale:e,samples:i}){let s=Uint8Array.from(atob(t),r=>r.charCodeAt(0));return n==="d2"?hm(s,i,e):new lm[n](s.buffer)}function hm(n,t,e){let i=n.length/2,s=i/t,r=new Float32Array(i);for(let o=0;o<s;o++){let a=0;for(let l=0;l<t;l++){let c=o*t+l;a=a+(n[c]|n[i+c]<<8)<<16>>16,r[l*s+o]=a*e}}return r}var to=class{constructor(t){Object.assign(this,t),this.arrays=Object.fromEntries(Object.entries(t.arrays).map(([e,i])=>[e,cm(i)])),this.phase=this.arrays.phase,this.samples=this.phase.length,this.last=this.phase[this.samples-1],this.advance=this.arrays.x[this.samples-1]-this.arrays.x[0]}locate(t){let e=0,i=this.samples-1;for(;i-e>1;){let r=e+i>>1;this.phase[r]<=t?e=r:i=r}let s=(t-this.phase[e])/(this.phase[i]-this.phase[e]);return{low:e,high:i,share:Math.min(Math.max(s,0),1)}}read(t,e,i){let s=this.arrays[t],r=s.length/this.samples,o=e.low*r,a=e.high*r;for(let l=0;l<r;l++)i[l]=s[o+l]+e.share*(s[a+l]-s[o+l]);return i}number(t,e){return this.read(t,e,[0])[0]}mean(t){let e=this.arrays[t];return e.reduce((i,s)=>i+s,0)/e.length}pivot(t,e){let{x:i,z:s}=this.arrays;if(!this.periodic)return[this.number("x",e),this.number("z",e)];let r=t/this.last,o=this.samples-1;return[i[0]+r*(i[o]-i[0]),s[0]+r*(s[o]-s[0])]}largest(t,e=1){let i=this.arrays[t],s=0;for(let r=0;r<i.length;r+=e){let o=0;for(let a=0;a<e;a++)o+=i[r+a]**2;s=Math.max(s,o)}return Math.sqrt(s)}};function eo(n,t){let{x:e,z:i}=n.arrays,s=n.samples-1,r=n.periodic?t:0,o=[];for(let a=-r;a<=0;a++){let l={phase:a*n.last,x:a*(e[s]-e[0]),z:a*(i[s]-i[0])};for(let c=a===-r?0:1;c<=s;c++)o.push({k:c,shift:l})}return o}function Gs(n,{k:t,shift:e}){return[n.arrays.x[t]+e.x,0,n.arrays.z[t]+e.z]}function Xl(n,t,e,i){let s=e*n.strips,r=Math.min(Math.floor(s),n.strips-1),o=12*(n.strips*t.k+r),{corners:a}=n.arrays,l=Gs(n,t);return[1,i,1].map((c,h)=>{let[u,d]=[0,3].map(f=>{let p=9-f;return .75*a[o+f+h]+.25*a[o+p+h]});return l[h]+c*(u+(s-r)*(d-u))})}function io(n,t,e){return Xl(n,t,1,e)}function ql(n){return Math.max(1,Math.round(n.strips/5))}function jn(n){let{force:t}=n.arrays;return Array.from({length:n.samples},(e,i)=>{let s=[0,0,0];for(let r=n.strips-ql(n);r<n.strips;r++)for(let o=0;o<3;o++)s[o]+=t[3*(n.strips*i+r)+o];return Math.hypot(...s)})}var um=110;function dm(n){let t=10**Math.floor(Math.log10(n));return[5,2,1].map(e=>e*t).find(e=>e<=n*(1+1e-9))}function nu(n,t,e){return e/(2*Math.tan(n.fov*Math.PI/360)*n.position.distanceTo(t))}var no=class{constructor(){this.bar=R("div",{class:"wb-bar-line"}),this.text=R("div",{}),this.element=R("div",{class:"wb-force-bar",hidden:!0},this.bar,this.text)}show(t,e,i){let s=e*t;if(this.element.hidden=!(s>0&&Number.isFinite(s)),this.element.hidden)return;this.force=dm(um/s),this.bar.style.width=`${this.force*s}px`;let r=Number((this.force/i).toPrecision(2));this.text.textContent=`force ${Pi(this.force)} N (${r} \xD7 weight)`}};var Vs=class{constructor(){this.bar=new no,this.trails=R("div",{}),this.ground=R("div",{}),this.wake=R("div",{},"wake: a sketch, not computed"),this.element=R("div",{class:"wb-measures"},this.bar.element,this.trails,this.wake,this.ground)}static tipForce(t){return Math.max(...t.flatMap(e=>jn(e)))}show(t,e,i){this.trails.hidden=!t.trails,this.wake.hidden=!t.wake,this.ground.hidden=!t.ground;let s=ql(e);this.trails.replaceChildren(R("div",{class:"wb-gradient",style:`background:${iu()}`}),R("div",{class:"wb-ends"},R("span",{},"0"),R("span",{},Pi(t.tipForce))),R("div",{},`trails: force on ${s>1?`${s} outer strips`:"the outer strip"} [N]`)),this.ground.textContent=`squares of ${Pi(i)} m`}follow(t,e,i){this.bar.show(t.perMetre,e.arrows.size?e.scale:0,i.weight)}};function su(n,t){return n.filter(({array:e})=>t.every(i=>e in i.arrays))}function sn(n,t){return n.made??=new Map,n.made.has(t.name)||n.made.set(t.name,fm(n,t)),n.made.get(t.name)}function fm(n,{array:t,scale:e,per:i,station:s}){let r=n.arrays[t],o=i?e/n[i]:e,a=new Float64Array(n.samples),{low:l,high:c,share:h}=pm(r.length/n.samples,s??0),u=r.length/n.samples;for(let d=0;d<n.samples;d++){let[f,p]=[r[d*u+l],r[d*u+c]];a[d]=o*(f+h*(p-f))}return a}function pm(n,t){let e=Math.min(Math.max(t*n-.5,0),n-1),i=Math.min(Math.floor(e),Math.max(n-2,0));return{low:i,high:Math.min(i+1,n-1),share:e-i}}function so(n,t,e){let i=sn(n,t);return i[e.low]+e.share*(i[e.high]-i[e.low])}function Ws(n,t=0,e=1/0){let[i,s]=[1/0,-1/0];for(let a of n)for(let l=t;l<=Math.min(e,a.length-1);l++)Number.isFinite(a[l])&&([i,s]=[Math.min(i,a[l]),Math.max(s,a[l])]);if(i>s)return[-1,1];i>0&&i<.4*s&&(i=0);let r=Math.max(Math.abs(i),Math.abs(s)),o=s-i>1e-6*r?.06*(s-i):.06*r||1;return[i-o,s+o]}function Xs(n){let t=new Map;for(let e of n)t.has(e.unit)||t.set(e.unit,[]),t.get(e.unit).push(e);return t}function rn(n){return n?`[${n}]`:"[-]"}function ro(n){return n.charAt(0).toUpperCase()+n.slice(1)}var mm=["fill","stroke","stroke-width","stroke-dasharray","stroke-linejoin","font-size","font-weight","visibility"],$l=4;function oo(n,t){let e=document.createElement("a");e.href=URL.createObjectURL(n),e.download=t,e.click(),setTimeout(()=>URL.revokeObjectURL(e.href),6e4)}function qs(n,t){return`${n.toLowerCase().replace(/[^\p{L}\p{N}]+/gu,"-").replace(/^-|-$/g,"").slice(0,60)||"flight"}.${t}`}async function gm(n,t){try{return await navigator.clipboard.write([new ClipboardItem({[t]:n})]),!0}catch{return!1}}async function ru(n,t,e,i,s){let r=await gm(t,e);r||oo(await t,i),n.tell(r?`Copied ${s}.`:`Saved ${s} as ${i}; the browser does not allow to copy it.`)}function xm(n){return typeof n=="number"?Number.isFinite(n)?String(Number(n.toPrecision(9))):"":/[",\n\r]/.test(n)?`"${n.replaceAll('"','""')}"`:n}function _m(n,t){let e=["phase [-]","time [s]",...t.map(({label:s,unit:r})=>`${s} ${rn(r)}`)],i=[n.length>1?["flight",...e]:e];for(let s of n){let r=[s.phase,s.arrays.time,...t.map(o=>sn(s,o))];for(let o=0;o<s.samples;o++){let a=r.map(l=>l[o]);i.push(n.length>1?[s.label,...a]:a)}}return i.map(s=>`${s.map(xm).join(",")}
`).join("")}function ym({choice:n,plots:t}){return[...n.x===Le?[]:[n.x],...n.ys].map(t.named)}async function ou(n){let{plots:t}=n,e=_m(t.flights,ym(n)),i=qs(`${t.flights[0].label} ${n.choice.ys.join(" ")}`,"csv"),s=new Blob([e],{type:"text/plain"});await ru(t,Promise.resolve(s),"text/plain",i,`${e.split(`
`).length-2} rows as CSV`)}function vm(n){let t=n.cloneNode(!0),[e,i]=[n,t].map(s=>[...s.querySelectorAll("*")]);return e.forEach((s,r)=>{let o=getComputedStyle(s);for(let a of mm)i[r].setAttribute(a,o.getPropertyValue(a))}),t}function bm(n){let{axes:t,choice:e,plots:i}=n,[,,s,r]=t.svg.getAttribute("viewBox").split(" ").map(Number),{color:o,backgroundColor:a}=getComputedStyle(n.element.closest(".wb-viewer")),l=e.ys.map((g,m)=>({text:i.named(g).label,curve:t.curves.querySelector(`.wb-curve-${m}`)})),c=14*l.length+4,u=[e.x===Le?"phase of the beat":`against ${i.named(e.x).label}`,...i.flights.length>1?[`solid: ${i.flights[0].label}; dashed: ${i.flights[1].label}`]:[]],d=(g,m,b)=>Et("text",{x:46,y:m,fill:b,"font-size":11},g),f=[s,c+r+14*u.length+4],p=vm(t.svg);for(let g of p.querySelectorAll(".wb-cursor, .wb-dot"))g.remove();for(let[g,m]of Object.entries({y:c,width:s,height:r}))p.setAttribute(g,m);let _=Et("svg",{xmlns:"http://www.w3.org/2000/svg",viewBox:`0 0 ${f.join(" ")}`,width:$l*f[0],height:$l*f[1]},Et("rect",{width:f[0],height:f[1],fill:a}),...l.map(({text:g,curve:m},b)=>d(g,14*(b+1),getComputedStyle(m).stroke)),p,...u.map((g,m)=>d(g,c+r+14*(m+1)-2,o)));return _.setAttribute("font-family","system-ui, sans-serif"),{address:`data:image/svg+xml;charset=utf-8,${encodeURIComponent(new XMLSerializer().serializeToString(_))}`,whole:f}}async function wm(n){let{address:t,whole:e}=bm(n),i=new Image;i.src=t,await i.decode();let s=document.createElement("canvas");return[s.width,s.height]=e.map(r=>$l*r),s.getContext("2d").drawImage(i,0,0,s.width,s.height),new Promise(r=>s.toBlob(r,"image/png"))}async function au(n){let{plots:t,choice:e}=n,i=qs(`${t.flights[0].label} ${e.ys.join(" ")}`,"png");await ru(t,wm(n),"image/png",i,"the plot as a picture")}var[$s,Qn]=[320,150],re={left:46,right:10,top:16,bottom:24},pi={width:$s-re.left-re.right,height:Qn-re.top-re.bottom},Mm=6,Sm=0;function lu(n,t,e){let i=nn((t-n)/e),s=[];for(let r=Math.ceil(n/i-1e-9);r*i<=t+1e-9*i;r++)s.push(r*i);return s.map(r=>Math.abs(r)<1e-9*i?0:r)}var ts=class{constructor(t,e){this.units=e;let i=`wb-clip-${++Sm}`;this.back=Et("g",{}),this.curves=Et("g",{"clip-path":`url(#${i})`}),this.front=Et("g",{"clip-path":`url(#${i})`}),this.chosen=Et("rect",{class:"wb-range",y:re.top,height:pi.height,visibility:"hidden"});let s={x:re.left,y:re.top,width:pi.width,height:pi.height},r=Et("rect",{class:"wb-axis",x:re.left,y:Qn-re.bottom,width:pi.width,height:re.bottom});r.append(Et("title",{},"Drag to zoom")),this.svg=Et("svg",{viewBox:`0 0 ${$s} ${Qn}`,role:"img","aria-label":t},Et("defs",{},Et("clipPath",{id:i},Et("rect",s))),this.back,this.curves,this.front,this.chosen,r),this.listen()}x(t){return re.left+(t-this.across[0])/(this.across[1]-this.across[0])*pi.width}y(t){return re.top+(this.along[1]-t)/(this.along[1]-this.along[0])*pi.height}setEnds(t,e,...i){[this.across,this.along]=[t,e];let[s,r]=[$s-re.right,Qn-re.bottom],o=lu(...e,4).flatMap(c=>[this.line(c,{x1:re.left,x2:s,y1:this.y(c),y2:this.y(c)}),Et("text",{class:"wb-tick",x:re.left-5,y:this.y(c)+3.5,"text-anchor":"end"},Pi(c))]),a=lu(...t,5).flatMap(c=>[this.line(c,{x1:this.x(c),x2:this.x(c),y1:re.top,y2:r}),Et("text",{class:"wb-tick",x:this.x(c),y:r+13,"text-anchor":"middle"},Pi(c))]),l=[Et("text",{class:"wb-unit",x:re.left-5,y:10,"text-anchor":"end"},rn(this.units[1])),Et("text",{class:"wb-unit",x:re.left-12,y:r+13,"text-anchor":"end"},rn(this.units[0]))];this.back.replaceChildren(...i.map(c=>this.shade(c)),...o,...a,...l)}line(t,e){return Et("line",{class:t===0?"wb-zero":"wb-grid",...e})}shade([t,e]){let[i,s]=[t,e].map(r=>Math.min(Math.max(this.x(r),re.left),$s-re.right));return Et("rect",{class:"wb-downstroke",x:i,y:re.top,width:s-i,height:pi.height})}path(t,e,i=0,s=t.length-1){let r=[];for(let o=i;o<=s;o++)Number.isFinite(e[o])&&r.push(`${this.x(t[o]).toFixed(2)},${this.y(e[o]).toFixed(2)}`);return r.join(" ")}place(t){let e=this.svg.getBoundingClientRect(),i=(t.clientX-e.left)/e.width*$s,s=(t.clientY-e.top)/e.height*Qn,[r,o]=[(i-re.left)/pi.width,1-(s-re.top)/pi.height].map(l=>Math.min(Math.max(l,0),1)),a=([l,c],h)=>l+h*(c-l);return{px:i,x:a(this.across,r),y:a(this.along,o),onAxis:s>Qn-re.bottom}}listen(){let t;this.svg.addEventListener("pointerdown",e=>{this.svg.setPointerCapture(e.pointerId),t=this.place(e),t.onAxis||this.seek(t.x,t.y)}),this.svg.addEventListener("pointermove",e=>{if(!e.buttons||!t)return;let i=this.place(e);t.onAxis?this.showRange(t.x,i.x):this.seek(i.x,i.y)}),this.svg.addEventListener("pointerup",e=>{let i=this.place(e);t?.onAxis&&Math.abs(i.px-t.px)>=Mm?this.zoomTo(t.x,i.x):t?.onAxis&&this.seek(i.x,i.y),this.forget(),t=void 0}),this.svg.addEventListener("pointercancel",()=>{this.forget(),t=void 0}),this.svg.addEventListener("dblclick",()=>this.reset()),this.svg.addEventListener("wheel",e=>this.wheel(e),{passive:!1})}wheel(t){let e=this.place(t);!e.onAxis&&!t.ctrlKey&&!this.svg.parentElement.contains(document.activeElement)||(t.preventDefault(),this.zoomBy(Math.exp(.0015*Math.min(Math.max(t.deltaY,-300),300)),e.x,e.y))}showRange(t,e){let[i,s]=[Math.min(t,e),Math.max(t,e)].map(r=>this.x(r));this.chosen.setAttribute("x",i),this.chosen.setAttribute("width",s-i),this.chosen.setAttribute("visibility","visible")}forget(){this.chosen.setAttribute("visibility","hidden")}};function Ys([n,t],e,i,[s,r]){let o=Math.min(Math.max((t-n)*e,.001*(r-s)),r-s),a=i-(i-n)/(t-n)*o,l=Math.min(Math.max(a,s),r-o);return[l,l+o]}var es=class extends ts{constructor(t,e,i,{seek:s,zoom:r,own:o}){super(`${ro(t.map(a=>a.label).join(" and "))} along the beat`,["",t[0].unit]),[this.series,this.flights,this.whole]=[t,e,[0,i]],this.seek=s,this.zoom=r,this.own=o,this.cursor=Et("line",{class:"wb-cursor",y1:0,y2:150}),this.dots=this.each((a,l,c,h)=>Et("circle",{class:`wb-dot wb-dot-${l} wb-at-${h}`,r:3})),this.front.append(this.cursor,...this.dots.flat()),this.draw(this.whole)}each(t){return this.series.map((e,i)=>this.flights.map((s,r)=>t(e,i,s,r)))}draw(t){let e=this.flights.map(a=>{let[l,c]=t.map(h=>a.locate(h));return[l.low,c.high]}),i=this.each((a,l,c,h)=>sn(c,a).subarray(e[h][0],e[h][1]+1)),s=this.owned();this.setEnds(t,Ws([...i.flat(),...s.map(({values:a})=>a)]),...this.flights[0].downstrokes);let r=this.each((a,l,c,h)=>Et("polyline",{class:`wb-curve wb-curve-${l} wb-flight-${h}`,points:this.path(c.phase,sn(c,a),...e[h])})),o=s.map(({phase:a,values:l,file:c})=>Et("polyline",{class:"wb-curve wb-own",points:this.path(a,l)},Et("title",{},c)));this.curves.replaceChildren(...r.flat(),...o)}owned(){return this.series.flatMap(({name:t,scale:e})=>this.own().filter(i=>i.name===t).map(i=>({...i,values:i.values.map(s=>s*e)})))}zoomBy(t,e){this.zoom(Ys(this.across,t,e,this.whole))}zoomTo(t,e){this.zoom([Math.min(t,e),Math.max(t,e)])}reset(){this.zoom(this.whole)}show(t){let e=this.x(t);return this.cursor.setAttribute("x1",e),this.cursor.setAttribute("x2",e),this.each((i,s,r,o)=>{let a=so(r,i,r.locate(t)),l=this.dots[s][o];return l.setAttribute("cx",e),l.setAttribute("cy",this.y(a)),a})}};var Em=.001,Zs=class extends ts{constructor(t,e,i,{seek:s}){super(`${ro(e.label)} against ${t.label}`,[t.unit,e.unit]),[this.xs,this.ys]=[t,e].map(r=>i.map(o=>sn(o,r))),[this.series,this.flights]=[[t,e],i],this.wholes=[Ws(this.xs),Ws(this.ys)],this.seekPhase=s,this.dots=i.map((r,o)=>Et("circle",{class:`wb-dot wb-dot-0 wb-at-${o}`,r:4})),this.front.append(...this.dots),this.draw(...this.wholes)}draw(t,e){this.setEnds(t,e),this.curves.replaceChildren(...this.flights.flatMap((i,s)=>[...i.downstrokes.map(r=>this.loop(s,"polyline","wb-thick",...this.samples(i,r))),this.loop(s,this.closed(s)?"polygon":"polyline","")]),this.start())}samples(t,e){return e.map(i=>{let{low:s,share:r}=t.locate(i);return s+Math.round(r)})}loop(t,e,i,s,r){let o=this.path(this.xs[t],this.ys[t],s,r);return Et(e,{class:`wb-curve wb-curve-0 wb-flight-${t} ${i}`,points:o})}closed(t){let e=this.flights[t].samples-1;return[[this.xs[t],this.wholes[0]],[this.ys[t],this.wholes[1]]].every(([i,[s,r]])=>Math.abs(i[e]-i[0])<Em*(r-s))}start(){return Et("circle",{class:"wb-start",cx:this.x(this.xs[0][0]),cy:this.y(this.ys[0][0]),r:3.5})}seek(t,e){let[i,s]=[0,1/0],[r,o]=[this.across,this.along].map(([a,l])=>l-a);for(let a=0;a<this.flights[0].samples;a++){let l=((this.xs[0][a]-t)/r*pi.width)**2+((this.ys[0][a]-e)/o*pi.height)**2;l<s&&([i,s]=[a,l])}this.seekPhase(this.flights[0].phase[i])}zoomBy(t,e,i=this.values?.[1][0]??0){this.draw(Ys(this.across,t,e,this.wholes[0]),Ys(this.along,t,i,this.wholes[1])),this.show(this.phase)}zoomTo(t,e){this.draw([Math.min(t,e),Math.max(t,e)],this.along),this.show(this.phase)}reset(){this.draw(...this.wholes),this.show(this.phase)}show(t){this.phase=t;let e=this.flights.map(i=>i.locate(t));return this.values=this.series.map(i=>this.flights.map((s,r)=>so(s,i,e[r]))),this.dots.forEach((i,s)=>{i.setAttribute("cx",this.x(this.values[0][s])),i.setAttribute("cy",this.y(this.values[1][s]))}),this.values}};var Le="phase";function Tm(n){return Number.isFinite(n)?String(Math.abs(n)<1e-9?0:n.toPrecision(3)):"no value"}var Js=class{constructor(t,e,i){[this.nth,this.plots]=[t,i],this.rows=R("div",{class:"wb-rows"}),this.foot=R("div",{class:"wb-foot"}),this.place=R("div",{class:"wb-plot",tabindex:"0",role:"group",onkeydown:s=>this.key(s)}),this.element=R("div",{class:"wb-card"},this.rows,this.place,this.foot),this.choose(e)}choose({ys:t,x:e}){this.choice={ys:e===Le?t:t.slice(0,1),x:e};let{flights:i,last:s,range:r,seek:o,named:a}=this.plots,l=this.choice.ys.map(a),c={seek:o,zoom:h=>this.plots.zoom(h),own:()=>this.plots.own};this.axes=e===Le?new es(l,i,s,c):new Zs(a(e),l[0],i,c),e===Le&&this.axes.draw(r),this.place.setAttribute("aria-label",`Plot ${this.nth+1}; plus and minus zoom, brackets move, 0 shows all`),this.place.replaceChildren(this.axes.svg),this.fillRows(l),this.fillFoot(),this.show(this.plots.phase)}fillRows(t){let{series:e}=this.plots;this.values=t.map(()=>R("span",{class:"wb-value"}));let i=t.map((r,o)=>{let a=o?Xs(e).get(t[0].unit):e,l=this.menu(`Curve ${o+1} of plot ${this.nth+1}`,a,r.name,c=>this.setCurve(o,c),o);return R("div",{class:"wb-row"},R("span",{class:`wb-key wb-key-${o}`}),l,this.values[o])}),s=Xs(e).get(t[0].unit);if(t.length===1&&this.choice.x===Le&&s.length>1){let r=`Second curve of plot ${this.nth+1}`,o=this.menu(r,s,"",a=>this.setCurve(1,a),1);i.push(R("div",{class:"wb-row"},R("span",{class:"wb-key"}),o))}this.rows.replaceChildren(...i)}menu(t,e,i,s,r=0){let o=R("select",{"aria-label":t,onchange:()=>s(o.value),class:i?!1:"wb-faint"});r&&o.append(R("option",{value:"",selected:i===""},i?"no second curve":"add a curve"));for(let[a,l]of Xs(e)){let c=l.map(({name:h,label:u})=>R("option",{value:h,selected:h===i},u));o.append(R("optgroup",{label:rn(a)},...c))}return o}setCurve(t,e){let{named:i}=this.plots,s=t?[this.choice.ys[0],e]:[e,this.choice.ys[1]],r=s.filter((o,a)=>o&&s.indexOf(o)===a&&i(o).unit===i(s[0]).unit);this.change({ys:r,x:this.choice.x},this.rows,t)}change(t,e,i){this.choose(t),e.querySelectorAll("select")[i]?.focus()}fillFoot(){let{series:t}=this.plots,e=`Plot ${this.nth+1} against`,i=R("select",{"aria-label":e,onchange:()=>this.change({...this.choice,x:i.value},this.foot,0)});i.append(R("option",{value:Le,selected:this.choice.x===Le},"phase"));for(let[r,o]of Xs(t)){let a=o.map(({name:l,label:c})=>R("option",{value:l,selected:l===this.choice.x},c));i.append(R("optgroup",{label:rn(r)},...a))}let s=(r,o,a)=>R("button",{type:"button","aria-label":o,title:o,onclick:a},r);this.across=R("span",{class:"wb-value"}),this.foot.replaceChildren(R("div",{class:"wb-row wb-across"},R("span",{class:"wb-against"},"against"),i,this.across),s("CSV",`Copy plot ${this.nth+1} as CSV`,()=>ou(this)),s("PNG",`Copy plot ${this.nth+1} as PNG picture`,()=>au(this)),s("\xD7",`Remove plot ${this.nth+1}`,()=>this.plots.remove(this)))}key(t){if(t.target!==this.place||t.ctrlKey||t.metaKey||t.altKey)return;let{axes:e,plots:i}=this,s=e instanceof es?[i.phase]:e.values.map(a=>a[0]),r=a=>i.shift(a),o={"+":()=>e.zoomBy(.7,...s),"=":()=>e.zoomBy(.7,...s),"-":()=>e.zoomBy(1/.7,...s),"[":()=>r(-.2),"]":()=>r(.2),0:()=>e.reset()};o[t.key]&&(o[t.key](),t.preventDefault(),t.stopPropagation())}show(t){let e=this.axes.show(t),{named:i}=this.plots;(this.axes instanceof es?e:[e[1]]).forEach((r,o)=>this.write(this.values[o],r,this.choice.ys[o])),this.axes instanceof Zs&&this.write(this.across,e[0],this.choice.x)}write(t,e,i){let{unit:s}=this.plots.named(i);t.textContent=`${e.map(Tm).join(" | ")}${s?` ${s}`:""}`}};var cu=8,ao=class{constructor(t,e,i,s){Object.assign(this,{flights:e,last:i,seek:s,phase:0,range:[0,i],cards:[],own:[]}),this.series=su(t.series,e),this.named=o=>this.series.find(a=>a.name===o),this.first=t.panels.map(o=>({ys:o,x:Le})),this.list=R("div",{class:"wb-plots"}),this.more=R("button",{type:"button",onclick:()=>this.add({ys:[this.series[0].name],x:Le})},"Add a plot"),this.told=R("output",{class:"wb-note"});let r=["The downstroke is shaded; in a plot of one series against another its line is thick."];e.length>1&&r.push(`Solid and first value: ${e[0].label}. Dashed: ${e[1].label}.`),this.element=R("div",{class:"wb-board"},this.list,R("div",{class:"wb-bar"},this.more,this.told),...r.map(o=>R("p",{class:"wb-note"},o))),this.choose(this.first)}get choices(){return this.cards.map(t=>t.choice)}choose(t){let e=t.filter(({ys:i,x:s})=>this.fit(i)&&(s===Le||this.named(s))).slice(0,cu);if(e.length){this.cards=[];for(let[i,s]of e.entries())this.cards.push(new Js(i,s,this));this.arrange()}}fit(t){let[e,i]=t.map(this.named);return e&&t.length<=2&&(t.length===1||i?.unit===e.unit)}overlay(t){return this.own=t.filter(({name:e})=>this.named(e)&&!this.named(e).per),this.zoom(this.range),this.own.map(({name:e})=>e)}include(t){let e=s=>this.cards.some(({choice:r})=>r.x===Le&&r.ys.includes(s)),i=t.filter(s=>!e(s)).map(s=>({ys:[s],x:Le}));i.length&&this.choose([...i,...this.choices])}add(t){this.cards.push(new Js(this.cards.length,t,this)),this.arrange(),this.cards.at(-1).rows.querySelector("select").focus()}remove(t){this.choose(this.choices.filter((e,i)=>i!==t.nth)),this.more.focus()}arrange(){this.list.replaceChildren(...this.cards.map(t=>t.element)),this.more.disabled=this.cards.length>=cu}tell(t){this.told.textContent=t}zoom(t){this.range=t;for(let e of this.cards)e.choice.x===Le&&e.axes.draw(t);this.show(this.phase)}shift(t){let[e,i]=this.range,s=Math.min(Math.max(t*(i-e),-e),this.last-i);this.zoom([e+s,i+s])}show(t){this.phase=t;for(let e of this.cards)e.show(t)}};var hu=n=>[...new Set(n)],lo=class{constructor(t,e){this.id=t,this.show=e,this.pushes=[],this.element=R("fieldset",{class:"wb-bar wb-push",hidden:!0})}offer(t){if(this.scene=t,this.pushes=t.pushes??[],this.element.hidden=this.pushes.length===0,this.element.hidden)return;this.direction=this.choice("Gust",hu(this.pushes.map(i=>i.direction))),this.size=this.choice("Size [m/s]",hu(this.pushes.map(i=>i.size))),this.feedback=R("input",{type:"checkbox"});let e=R("label",{class:"wb-toggle"},this.feedback,"feedback");e.hidden=!this.pushes.some(i=>i.feedback),this.back=R("button",{type:"button",hidden:!0,onclick:()=>this.reset()},"Back to the orbit"),this.outcome=R("output",{class:"wb-outcome","aria-live":"polite"}),this.element.replaceChildren(R("legend",{},"Push it"),this.direction.element,this.size.element,e,R("button",{type:"button",onclick:()=>this.push()},"Push"),this.back,this.outcome)}choice(t,e){let i=`${this.id}-push-${t.replace(/\W/g,"")}`,s=R("select",{id:i});for(let r of e)s.append(R("option",{value:r},String(r)));return{select:s,element:R("span",{class:"wb-choice"},R("label",{for:i},t),s)}}get chosen(){return this.pushes.find(t=>t.direction===this.direction.select.value&&String(t.size)===this.size.select.value&&t.feedback===this.feedback.checked)}choose({direction:t,size:e,feedback:i}){this.direction.select.value=t,this.size.select.value=e,this.feedback.checked=i,this.push()}push(){let{scene:t,outcome:e}=this.chosen;this.outcome.textContent=e,this.back.hidden=!1,this.show(t,!0)}reset(){this.outcome.textContent="",this.back.hidden=!0,this.show(this.scene,!1)}};/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */var _n={LEFT:0,MIDDLE:1,RIGHT:2,ROTATE:0,DOLLY:1,PAN:2},yn={ROTATE:0,PAN:1,DOLLY_PAN:2,DOLLY_ROTATE:3},Vu=0,Ec=1,Wu=2;var Cr=1,Xu=2,As=3,vn=0,je=1,Me=2,zn=0,Rs=1,Tc=2,Ac=3,Rc=4,qu=5;var Hn=100,$u=101,Yu=102,Zu=103,Ju=104,Ku=200,ju=201,Qu=202,td=203,Cc=204,Pc=205,ed=206,id=207,nd=208,sd=209,rd=210,od=211,ad=212,ld=213,cd=214,Uo=0,Oo=1,Fo=2,xs=3,Bo=4,ko=5,zo=6,Ho=7,pa=0,hd=1,ud=2,Ni=0,Ic=1,Lc=2,Dc=3,Nc=4,Uc=5,Oc=6,Fc=7;var Bc=300,Gn=301,Cs=302,ma=303,ga=304,Go=1e3,Li=1001,Vo=1002,Ue=1003,dd=1004;var Pr=1005;var Ze=1006,xa=1007;var Ji=1008;var ei=1009,kc=1010,zc=1011,Ps=1012,_a=1013,Ei=1014,xi=1015,Ti=1016,ya=1017,va=1018,Vn=1020,Hc=35902,Gc=35899,Vc=1021,Wc=1022,Ai=1023,Wi=1026,Ki=1027,ba=1028,wa=1029,bn=1030,Ma=1031;var Sa=1033,Ir=33776,Lr=33777,Dr=33778,Nr=33779,Ea=35840,Ta=35841,Aa=35842,Ra=35843,Ca=36196,Pa=37492,Ia=37496,La=37488,Da=37489,Ur=37490,Na=37491,Ua=37808,Oa=37809,Fa=37810,Ba=37811,ka=37812,za=37813,Ha=37814,Ga=37815,Va=37816,Wa=37817,Xa=37818,qa=37819,$a=37820,Ya=37821,Za=36492,Ja=36494,Ka=36495,ja=36283,Qa=36284,Or=36285,tl=36286;var ar=2300,Wo=2301,Do=2302,_c=2303,yc=2400,vc=2401,bc=2402;var fd=3200;var el=0,pd=1,ji="",xe="srgb",lr="srgb-linear",cr="linear",jt="srgb";var No=7680;var md=519,gd=512,xd=513,_d=514,Xc=515,yd=516,vd=517,qc=518,$c=519,bd=35044;var Yc="300 es",gi=2e3,_s=2001;function Am(n){for(let t=n.length-1;t>=0;--t)if(n[t]>=65535)return!0;return!1}function Rm(n){return ArrayBuffer.isView(n)&&!(n instanceof DataView)}function hr(n){return document.createElementNS("http://www.w3.org/1999/xhtml",n)}function wd(){let n=hr("canvas");return n.style.display="block",n}var uu={},ys=null;function Zc(...n){let t="THREE."+n.shift();ys?ys("log",t,...n):console.log(t,...n)}function Md(n){let t=n[0];if(typeof t=="string"&&t.startsWith("TSL:")){let e=n[1];e&&e.isStackTrace?n[0]+=" "+e.getLocation():n[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return n}function At(...n){n=Md(n);let t="THREE."+n.shift();if(ys)ys("warn",t,...n);else{let e=n[0];e&&e.isStackTrace?console.warn(e.getError(t)):console.warn(t,...n)}}function Dt(...n){n=Md(n);let t="THREE."+n.shift();if(ys)ys("error",t,...n);else{let e=n[0];e&&e.isStackTrace?console.error(e.getError(t)):console.error(t,...n)}}function sr(...n){let t=n.join(" ");t in uu||(uu[t]=!0,At(...n))}function Sd(n,t,e){return new Promise(function(i,s){function r(){switch(n.clientWaitSync(t,n.SYNC_FLUSH_COMMANDS_BIT,0)){case n.WAIT_FAILED:s();break;case n.TIMEOUT_EXPIRED:setTimeout(r,e);break;default:i()}}setTimeout(r,e)})}var Ed={[Uo]:Uo,[Fo]:zo,[Bo]:Bo,[xs]:ko,[Oo]:Oo,[zo]:Fo,[Ho]:Ho,[ko]:xs},Si=class{addEventListener(t,e){this._listeners===void 0&&(this._listeners={});let i=this._listeners;i[t]===void 0&&(i[t]=[]),i[t].indexOf(e)===-1&&i[t].push(e)}hasEventListener(t,e){let i=this._listeners;return i===void 0?!1:i[t]!==void 0&&i[t].indexOf(e)!==-1}removeEventListener(t,e){let i=this._listeners;if(i===void 0)return;let s=i[t];if(s!==void 0){let r=s.indexOf(e);r!==-1&&s.splice(r,1)}}dispatchEvent(t){let e=this._listeners;if(e===void 0)return;let i=e[t.type];if(i!==void 0){t.target=this;let s=i.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,t);t.target=null}}},Ve=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"],du=1234567,rr=Math.PI/180,vs=180/Math.PI;function Is(){let n=Math.random()*4294967295|0,t=Math.random()*4294967295|0,e=Math.random()*4294967295|0,i=Math.random()*4294967295|0;return(Ve[n&255]+Ve[n>>8&255]+Ve[n>>16&255]+Ve[n>>24&255]+"-"+Ve[t&255]+Ve[t>>8&255]+"-"+Ve[t>>16&15|64]+Ve[t>>24&255]+"-"+Ve[e&63|128]+Ve[e>>8&255]+"-"+Ve[e>>16&255]+Ve[e>>24&255]+Ve[i&255]+Ve[i>>8&255]+Ve[i>>16&255]+Ve[i>>24&255]).toLowerCase()}function Ht(n,t,e){return Math.max(t,Math.min(e,n))}function Jc(n,t){return(n%t+t)%t}function Cm(n,t,e,i,s){return i+(n-t)*(s-i)/(e-t)}function Pm(n,t,e){return n!==t?(e-n)/(t-n):0}function or(n,t,e){return(1-e)*n+e*t}function Im(n,t,e,i){return or(n,t,1-Math.exp(-e*i))}function Lm(n,t=1){return t-Math.abs(Jc(n,t*2)-t)}function Dm(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*(3-2*n))}function Nm(n,t,e){return n<=t?0:n>=e?1:(n=(n-t)/(e-t),n*n*n*(n*(n*6-15)+10))}function Um(n,t){return n+Math.floor(Math.random()*(t-n+1))}function Om(n,t){return n+Math.random()*(t-n)}function Fm(n){return n*(.5-Math.random())}function Bm(n){n!==void 0&&(du=n);let t=du+=1831565813;return t=Math.imul(t^t>>>15,t|1),t^=t+Math.imul(t^t>>>7,t|61),((t^t>>>14)>>>0)/4294967296}function km(n){return n*rr}function zm(n){return n*vs}function Hm(n){return n>0&&Number.isInteger(n)&&2**Math.round(Math.log2(n))===n}function Gm(n){return Math.pow(2,Math.ceil(Math.log(n)/Math.LN2))}function Kc(n){return Math.pow(2,Math.floor(Math.log(n)/Math.LN2))}function Vm(n,t,e,i,s){let r=Math.cos,o=Math.sin,a=r(e/2),l=o(e/2),c=r((t+i)/2),h=o((t+i)/2),u=r((t-i)/2),d=o((t-i)/2),f=r((i-t)/2),p=o((i-t)/2);switch(s){case"XYX":n.set(a*h,l*u,l*d,a*c);break;case"YZY":n.set(l*d,a*h,l*u,a*c);break;case"ZXZ":n.set(l*u,l*d,a*h,a*c);break;case"XZX":n.set(a*h,l*p,l*f,a*c);break;case"YXY":n.set(l*f,a*h,l*p,a*c);break;case"ZYZ":n.set(l*p,l*f,a*h,a*c);break;default:At("MathUtils: .setQuaternionFromProperEuler() encountered an unknown order: "+s)}}function jc(n){switch(n.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function Td(n,t){if(t.constructor===Float32Array)return n;let e=jc(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(n/e,-1)}function Ad(n,t){if(t.constructor===Float32Array)return n;let e=jc(t);if(e===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(n*e)}var Qc={DEG2RAD:rr,RAD2DEG:vs,generateUUID:Is,clamp:Ht,euclideanModulo:Jc,mapLinear:Cm,inverseLerp:Pm,lerp:or,damp:Im,pingpong:Lm,smoothstep:Dm,smootherstep:Nm,randInt:Um,randFloat:Om,randFloatSpread:Fm,seededRandom:Bm,degToRad:km,radToDeg:zm,isPowerOfTwo:Hm,ceilPowerOfTwo:Gm,floorPowerOfTwo:Kc,setQuaternionFromProperEuler:Vm,normalize:Ad,denormalize:Td},Lt=class{static{this.prototype.isVector2=!0}constructor(t=0,e=0){this.x=t,this.y=e}get width(){return this.x}set width(t){this.x=t}get height(){return this.y}set height(t){this.y=t}set(t,e){return this.x=t,this.y=e,this}setScalar(t){return this.x=t,this.y=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;default:throw new Error("THREE.Vector2: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y)}copy(t){return this.x=t.x,this.y=t.y,this}add(t){return this.x+=t.x,this.y+=t.y,this}addScalar(t){return this.x+=t,this.y+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this}subScalar(t){return this.x-=t,this.y-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this}multiply(t){return this.x*=t.x,this.y*=t.y,this}multiplyScalar(t){return this.x*=t,this.y*=t,this}divide(t){return this.x/=t.x,this.y/=t.y,this}divideScalar(t){return this.multiplyScalar(1/t)}applyMatrix3(t){let e=this.x,i=this.y,s=t.elements;return this.x=s[0]*e+s[3]*i+s[6],this.y=s[1]*e+s[4]*i+s[7],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this}clamp(t,e){return this.x=Ht(this.x,t.x,e.x),this.y=Ht(this.y,t.y,e.y),this}clampScalar(t,e){return this.x=Ht(this.x,t,e),this.y=Ht(this.y,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ht(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(t){return this.x*t.x+this.y*t.y}cross(t){return this.x*t.y-this.y*t.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Ht(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y;return e*e+i*i}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this}equals(t){return t.x===this.x&&t.y===this.y}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this}rotateAround(t,e){let i=Math.cos(e),s=Math.sin(e),r=this.x-t.x,o=this.y-t.y;return this.x=r*i-o*s+t.x,this.y=r*s+o*i+t.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}},Je=class{constructor(t=0,e=0,i=0,s=1){this.isQuaternion=!0,this._x=t,this._y=e,this._z=i,this._w=s}static slerpFlat(t,e,i,s,r,o,a){let l=i[s+0],c=i[s+1],h=i[s+2],u=i[s+3],d=r[o+0],f=r[o+1],p=r[o+2],_=r[o+3];if(u!==_||l!==d||c!==f||h!==p){let g=l*d+c*f+h*p+u*_;g<0&&(d=-d,f=-f,p=-p,_=-_,g=-g);let m=1-a;if(g<.9995){let b=Math.acos(g),S=Math.sin(b);m=Math.sin(m*b)/S,a=Math.sin(a*b)/S,l=l*m+d*a,c=c*m+f*a,h=h*m+p*a,u=u*m+_*a}else{l=l*m+d*a,c=c*m+f*a,h=h*m+p*a,u=u*m+_*a;let b=1/Math.sqrt(l*l+c*c+h*h+u*u);l*=b,c*=b,h*=b,u*=b}}t[e]=l,t[e+1]=c,t[e+2]=h,t[e+3]=u}static multiplyQuaternionsFlat(t,e,i,s,r,o){let a=i[s],l=i[s+1],c=i[s+2],h=i[s+3],u=r[o],d=r[o+1],f=r[o+2],p=r[o+3];return t[e]=a*p+h*u+l*f-c*d,t[e+1]=l*p+h*d+c*u-a*f,t[e+2]=c*p+h*f+a*d-l*u,t[e+3]=h*p-a*u-l*d-c*f,t}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get w(){return this._w}set w(t){this._w=t,this._onChangeCallback()}set(t,e,i,s){return this._x=t,this._y=e,this._z=i,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(t){return this._x=t.x,this._y=t.y,this._z=t.z,this._w=t.w,this._onChangeCallback(),this}setFromEuler(t,e=!0){let i=t._x,s=t._y,r=t._z,o=t._order,a=Math.cos,l=Math.sin,c=a(i/2),h=a(s/2),u=a(r/2),d=l(i/2),f=l(s/2),p=l(r/2);switch(o){case"XYZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"YXZ":this._x=d*h*u+c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"ZXY":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u-d*f*p;break;case"ZYX":this._x=d*h*u-c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u+d*f*p;break;case"YZX":this._x=d*h*u+c*f*p,this._y=c*f*u+d*h*p,this._z=c*h*p-d*f*u,this._w=c*h*u-d*f*p;break;case"XZY":this._x=d*h*u-c*f*p,this._y=c*f*u-d*h*p,this._z=c*h*p+d*f*u,this._w=c*h*u+d*f*p;break;default:At("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return e===!0&&this._onChangeCallback(),this}setFromAxisAngle(t,e){let i=e/2,s=Math.sin(i);return this._x=t.x*s,this._y=t.y*s,this._z=t.z*s,this._w=Math.cos(i),this._onChangeCallback(),this}setFromRotationMatrix(t){let e=t.elements,i=e[0],s=e[4],r=e[8],o=e[1],a=e[5],l=e[9],c=e[2],h=e[6],u=e[10],d=i+a+u;if(d>0){let f=.5/Math.sqrt(d+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(i>a&&i>u){let f=2*Math.sqrt(1+i-a-u);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>u){let f=2*Math.sqrt(1+a-i-u);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+u-i-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(t,e){let i=t.dot(e)+1;return i<1e-8?(i=0,Math.abs(t.x)>Math.abs(t.z)?(this._x=-t.y,this._y=t.x,this._z=0,this._w=i):(this._x=0,this._y=-t.z,this._z=t.y,this._w=i)):(this._x=t.y*e.z-t.z*e.y,this._y=t.z*e.x-t.x*e.z,this._z=t.x*e.y-t.y*e.x,this._w=i),this.normalize()}angleTo(t){return 2*Math.acos(Math.abs(Ht(this.dot(t),-1,1)))}rotateTowards(t,e){let i=this.angleTo(t);if(i===0)return this;let s=Math.min(1,e/i);return this.slerp(t,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(t){return this._x*t._x+this._y*t._y+this._z*t._z+this._w*t._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let t=this.length();return t===0?(this._x=0,this._y=0,this._z=0,this._w=1):(t=1/t,this._x=this._x*t,this._y=this._y*t,this._z=this._z*t,this._w=this._w*t),this._onChangeCallback(),this}multiply(t){return this.multiplyQuaternions(this,t)}premultiply(t){return this.multiplyQuaternions(t,this)}multiplyQuaternions(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=e._x,l=e._y,c=e._z,h=e._w;return this._x=i*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-i*c,this._z=r*h+o*c+i*l-s*a,this._w=o*h-i*a-s*l-r*c,this._onChangeCallback(),this}slerp(t,e){let i=t._x,s=t._y,r=t._z,o=t._w,a=this.dot(t);a<0&&(i=-i,s=-s,r=-r,o=-o,a=-a);let l=1-e;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,e=Math.sin(e*c)/h,this._x=this._x*l+i*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this._onChangeCallback()}else this._x=this._x*l+i*e,this._y=this._y*l+s*e,this._z=this._z*l+r*e,this._w=this._w*l+o*e,this.normalize();return this}slerpQuaternions(t,e,i){return this.copy(t).slerp(e,i)}random(){let t=2*Math.PI*Math.random(),e=2*Math.PI*Math.random(),i=Math.random(),s=Math.sqrt(1-i),r=Math.sqrt(i);return this.set(s*Math.sin(t),s*Math.cos(t),r*Math.sin(e),r*Math.cos(e))}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._w===this._w}fromArray(t,e=0){return this._x=t[e],this._y=t[e+1],this._z=t[e+2],this._w=t[e+3],this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._w,t}fromBufferAttribute(t,e){return this._x=t.getX(e),this._y=t.getY(e),this._z=t.getZ(e),this._w=t.getW(e),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},N=class{static{this.prototype.isVector3=!0}constructor(t=0,e=0,i=0){this.x=t,this.y=e,this.z=i}set(t,e,i){return i===void 0&&(i=this.z),this.x=t,this.y=e,this.z=i,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;default:throw new Error("THREE.Vector3: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this}multiplyVectors(t,e){return this.x=t.x*e.x,this.y=t.y*e.y,this.z=t.z*e.z,this}applyEuler(t){return this.applyQuaternion(fu.setFromEuler(t))}applyAxisAngle(t,e){return this.applyQuaternion(fu.setFromAxisAngle(t,e))}applyMatrix3(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[3]*i+r[6]*s,this.y=r[1]*e+r[4]*i+r[7]*s,this.z=r[2]*e+r[5]*i+r[8]*s,this}applyNormalMatrix(t){return this.applyMatrix3(t).normalize()}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=t.elements,o=1/(r[3]*e+r[7]*i+r[11]*s+r[15]);return this.x=(r[0]*e+r[4]*i+r[8]*s+r[12])*o,this.y=(r[1]*e+r[5]*i+r[9]*s+r[13])*o,this.z=(r[2]*e+r[6]*i+r[10]*s+r[14])*o,this}applyQuaternion(t){let e=this.x,i=this.y,s=this.z,r=t.x,o=t.y,a=t.z,l=t.w,c=2*(o*s-a*i),h=2*(a*e-r*s),u=2*(r*i-o*e);return this.x=e+l*c+o*u-a*h,this.y=i+l*h+a*c-r*u,this.z=s+l*u+r*h-o*c,this}project(t){return this.applyMatrix4(t.matrixWorldInverse).applyMatrix4(t.projectionMatrix)}unproject(t){return this.applyMatrix4(t.projectionMatrixInverse).applyMatrix4(t.matrixWorld)}transformDirection(t){let e=this.x,i=this.y,s=this.z,r=t.elements;return this.x=r[0]*e+r[4]*i+r[8]*s,this.y=r[1]*e+r[5]*i+r[9]*s,this.z=r[2]*e+r[6]*i+r[10]*s,this.normalize()}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this}divideScalar(t){return this.multiplyScalar(1/t)}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this}clamp(t,e){return this.x=Ht(this.x,t.x,e.x),this.y=Ht(this.y,t.y,e.y),this.z=Ht(this.z,t.z,e.z),this}clampScalar(t,e){return this.x=Ht(this.x,t,e),this.y=Ht(this.y,t,e),this.z=Ht(this.z,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ht(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this}cross(t){return this.crossVectors(this,t)}crossVectors(t,e){let i=t.x,s=t.y,r=t.z,o=e.x,a=e.y,l=e.z;return this.x=s*l-r*a,this.y=r*o-i*l,this.z=i*a-s*o,this}projectOnVector(t){let e=t.lengthSq();if(e===0)return this.set(0,0,0);let i=t.dot(this)/e;return this.copy(t).multiplyScalar(i)}projectOnPlane(t){return Yl.copy(this).projectOnVector(t),this.sub(Yl)}reflect(t){return this.sub(Yl.copy(t).multiplyScalar(2*this.dot(t)))}angleTo(t){let e=Math.sqrt(this.lengthSq()*t.lengthSq());if(e===0)return Math.PI/2;let i=this.dot(t)/e;return Math.acos(Ht(i,-1,1))}distanceTo(t){return Math.sqrt(this.distanceToSquared(t))}distanceToSquared(t){let e=this.x-t.x,i=this.y-t.y,s=this.z-t.z;return e*e+i*i+s*s}manhattanDistanceTo(t){return Math.abs(this.x-t.x)+Math.abs(this.y-t.y)+Math.abs(this.z-t.z)}setFromSpherical(t){return this.setFromSphericalCoords(t.radius,t.phi,t.theta)}setFromSphericalCoords(t,e,i){let s=Math.sin(e)*t;return this.x=s*Math.sin(i),this.y=Math.cos(e)*t,this.z=s*Math.cos(i),this}setFromCylindrical(t){return this.setFromCylindricalCoords(t.radius,t.theta,t.y)}setFromCylindricalCoords(t,e,i){return this.x=t*Math.sin(e),this.y=i,this.z=t*Math.cos(e),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this}setFromMatrixScale(t){let e=this.setFromMatrixColumn(t,0).length(),i=this.setFromMatrixColumn(t,1).length(),s=this.setFromMatrixColumn(t,2).length();return this.x=e,this.y=i,this.z=s,this}setFromMatrixColumn(t,e){return this.fromArray(t.elements,e*4)}setFromMatrix3Column(t,e){return this.fromArray(t.elements,e*3)}setFromEuler(t){return this.x=t._x,this.y=t._y,this.z=t._z,this}setFromColor(t){return this.x=t.r,this.y=t.g,this.z=t.b,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let t=Math.random()*Math.PI*2,e=Math.random()*2-1,i=Math.sqrt(1-e*e);return this.x=i*Math.cos(t),this.y=e,this.z=i*Math.sin(t),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}},Yl=new N,fu=new Je,Nt=class{static{this.prototype.isMatrix3=!0}constructor(t,e,i,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,l,c)}set(t,e,i,s,r,o,a,l,c){let h=this.elements;return h[0]=t,h[1]=s,h[2]=a,h[3]=e,h[4]=r,h[5]=l,h[6]=i,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],this}extractBasis(t,e,i){return t.setFromMatrix3Column(this,0),e.setFromMatrix3Column(this,1),i.setFromMatrix3Column(this,2),this}setFromMatrix4(t){let e=t.elements;return this.set(e[0],e[4],e[8],e[1],e[5],e[9],e[2],e[6],e[10]),this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[3],l=i[6],c=i[1],h=i[4],u=i[7],d=i[2],f=i[5],p=i[8],_=s[0],g=s[3],m=s[6],b=s[1],S=s[4],w=s[7],E=s[2],T=s[5],x=s[8];return r[0]=o*_+a*b+l*E,r[3]=o*g+a*S+l*T,r[6]=o*m+a*w+l*x,r[1]=c*_+h*b+u*E,r[4]=c*g+h*S+u*T,r[7]=c*m+h*w+u*x,r[2]=d*_+f*b+p*E,r[5]=d*g+f*S+p*T,r[8]=d*m+f*w+p*x,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[3]*=t,e[6]*=t,e[1]*=t,e[4]*=t,e[7]*=t,e[2]*=t,e[5]*=t,e[8]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8];return e*o*h-e*a*c-i*r*h+i*a*l+s*r*c-s*o*l}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=h*o-a*c,d=a*l-h*r,f=c*r-o*l,p=e*u+i*d+s*f;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let _=1/p;return t[0]=u*_,t[1]=(s*c-h*i)*_,t[2]=(a*i-s*o)*_,t[3]=d*_,t[4]=(h*e-s*l)*_,t[5]=(s*r-a*e)*_,t[6]=f*_,t[7]=(i*l-c*e)*_,t[8]=(o*e-i*r)*_,this}transpose(){let t,e=this.elements;return t=e[1],e[1]=e[3],e[3]=t,t=e[2],e[2]=e[6],e[6]=t,t=e[5],e[5]=e[7],e[7]=t,this}getNormalMatrix(t){return this.setFromMatrix4(t).invert().transpose()}transposeIntoArray(t){let e=this.elements;return t[0]=e[0],t[1]=e[3],t[2]=e[6],t[3]=e[1],t[4]=e[4],t[5]=e[7],t[6]=e[2],t[7]=e[5],t[8]=e[8],this}setUvTransform(t,e,i,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(i*l,i*c,-i*(l*o+c*a)+o+t,-s*c,s*l,-s*(-c*o+l*a)+a+e,0,0,1),this}scale(t,e){return sr("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(Zl.makeScale(t,e)),this}rotate(t){return sr("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(Zl.makeRotation(-t)),this}translate(t,e){return sr("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(Zl.makeTranslation(t,e)),this}makeTranslation(t,e){return t.isVector2?this.set(1,0,t.x,0,1,t.y,0,0,1):this.set(1,0,t,0,1,e,0,0,1),this}makeRotation(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,i,e,0,0,0,1),this}makeScale(t,e){return this.set(t,0,0,0,e,0,0,0,1),this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<9;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<9;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t}clone(){return new this.constructor().fromArray(this.elements)}},Zl=new Nt,pu=new Nt().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),mu=new Nt().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function Wm(){let n={enabled:!0,workingColorSpace:lr,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===jt&&(s.r=Vi(s.r),s.g=Vi(s.g),s.b=Vi(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===jt&&(s.r=gs(s.r),s.g=gs(s.g),s.b=gs(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===ji?cr:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},t=[.64,.33,.3,.6,.15,.06],e=[.2126,.7152,.0722],i=[.3127,.329];return n.define({[lr]:{primaries:t,whitePoint:i,transfer:cr,toXYZ:pu,fromXYZ:mu,luminanceCoefficients:e,workingColorSpaceConfig:{unpackColorSpace:xe},outputColorSpaceConfig:{drawingBufferColorSpace:xe}},[xe]:{primaries:t,whitePoint:i,transfer:jt,toXYZ:pu,fromXYZ:mu,luminanceCoefficients:e,outputColorSpaceConfig:{drawingBufferColorSpace:xe}}}),n}var qt=Wm();function Vi(n){return n<.04045?n*.0773993808:Math.pow(n*.9478672986+.0521327014,2.4)}function gs(n){return n<.0031308?n*12.92:1.055*Math.pow(n,.41666)-.055}var is,Xo=class{static getDataURL(t,e="image/png"){if(/^data:/i.test(t.src)||typeof HTMLCanvasElement>"u")return t.src;let i;if(t instanceof HTMLCanvasElement)i=t;else{is===void 0&&(is=hr("canvas")),is.width=t.width,is.height=t.height;let s=is.getContext("2d");t instanceof ImageData?s.putImageData(t,0,0):s.drawImage(t,0,0,t.width,t.height),i=is}return i.toDataURL(e)}static sRGBToLinear(t){if(typeof HTMLImageElement<"u"&&t instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&t instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&t instanceof ImageBitmap){let e=hr("canvas");e.width=t.width,e.height=t.height;let i=e.getContext("2d");i.drawImage(t,0,0,t.width,t.height);let s=i.getImageData(0,0,t.width,t.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=Vi(r[o]/255)*255;return i.putImageData(s,0,0),e}else if(t.data){let e=t.data.slice(0);for(let i=0;i<e.length;i++)e instanceof Uint8Array||e instanceof Uint8ClampedArray?e[i]=Math.floor(Vi(e[i]/255)*255):e[i]=Vi(e[i]);return{data:e,width:t.width,height:t.height}}else return At("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),t}},Xm=0,bs=class{constructor(t=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:Xm++}),this.uuid=Is(),this.data=t,this.dataReady=!0,this.version=0}getSize(t){let e=this.data;return typeof HTMLVideoElement<"u"&&e instanceof HTMLVideoElement?t.set(e.videoWidth,e.videoHeight,0):typeof VideoFrame<"u"&&e instanceof VideoFrame?t.set(e.displayWidth,e.displayHeight,0):e!==null?t.set(e.width||0,e.height||0,e.depth||0):t.set(0,0,0),t}set needsUpdate(t){t===!0&&this.version++}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.images[this.uuid]!==void 0)return t.images[this.uuid];let i={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Jl(s[o].image)):r.push(Jl(s[o]))}else r=Jl(s);i.url=r}return e||(t.images[this.uuid]=i),i}};function Jl(n){return typeof HTMLImageElement<"u"&&n instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&n instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&n instanceof ImageBitmap?Xo.getDataURL(n):n.data?{data:Array.from(n.data),width:n.width,height:n.height,type:n.data.constructor.name}:(At("Texture: Unable to serialize Texture."),{})}var qm=0,Kl=new N,ti=class n extends Si{constructor(t=n.DEFAULT_IMAGE,e=n.DEFAULT_MAPPING,i=Li,s=Li,r=Ze,o=Ji,a=Ai,l=ei,c=n.DEFAULT_ANISOTROPY,h=ji){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:qm++}),this.uuid=Is(),this.name="",this.source=new bs(t),this.mipmaps=[],this.mapping=e,this.channel=0,this.wrapS=i,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new Lt(0,0),this.repeat=new Lt(1,1),this.center=new Lt(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new Nt,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(t&&t.depth&&t.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Kl).x}get height(){return this.source.getSize(Kl).y}get depth(){return this.source.getSize(Kl).z}get image(){return this.source.data}set image(t){this.source.data=t}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(t){return this.name=t.name,this.source=t.source,this.mipmaps=t.mipmaps.slice(0),this.mapping=t.mapping,this.channel=t.channel,this.wrapS=t.wrapS,this.wrapT=t.wrapT,this.magFilter=t.magFilter,this.minFilter=t.minFilter,this.anisotropy=t.anisotropy,this.format=t.format,this.internalFormat=t.internalFormat,this.type=t.type,this.normalized=t.normalized,this.offset.copy(t.offset),this.repeat.copy(t.repeat),this.center.copy(t.center),this.rotation=t.rotation,this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrix.copy(t.matrix),this.generateMipmaps=t.generateMipmaps,this.mipmapsAutoUpdate=t.mipmapsAutoUpdate,this.premultiplyAlpha=t.premultiplyAlpha,this.flipY=t.flipY,this.unpackAlignment=t.unpackAlignment,this.colorSpace=t.colorSpace,this.renderTarget=t.renderTarget,this.isRenderTargetTexture=t.isRenderTargetTexture,this.isPMREMTexture=t.isPMREMTexture,this.isArrayTexture=t.isArrayTexture,this.userData=JSON.parse(JSON.stringify(t.userData)),this.needsUpdate=!0,this}setValues(t){for(let e in t){let i=t[e];if(i===void 0){At(`Texture.setValues(): parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){At(`Texture.setValues(): property '${e}' does not exist.`);continue}s&&i&&s.isVector2&&i.isVector2||s&&i&&s.isVector3&&i.isVector3||s&&i&&s.isMatrix3&&i.isMatrix3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";if(!e&&t.textures[this.uuid]!==void 0)return t.textures[this.uuid];let i={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(t).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(i.userData=this.userData),e||(t.textures[this.uuid]=i),i}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(t){if(this.mapping!==Bc)return t;if(t.applyMatrix3(this.matrix),t.x<0||t.x>1)switch(this.wrapS){case Go:t.x=t.x-Math.floor(t.x);break;case Li:t.x=t.x<0?0:1;break;case Vo:Math.abs(Math.floor(t.x)%2)===1?t.x=Math.ceil(t.x)-t.x:t.x=t.x-Math.floor(t.x);break}if(t.y<0||t.y>1)switch(this.wrapT){case Go:t.y=t.y-Math.floor(t.y);break;case Li:t.y=t.y<0?0:1;break;case Vo:Math.abs(Math.floor(t.y)%2)===1?t.y=Math.ceil(t.y)-t.y:t.y=t.y-Math.floor(t.y);break}return this.flipY&&(t.y=1-t.y),t}set needsUpdate(t){t===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(t){t===!0&&this.pmremVersion++}};ti.DEFAULT_IMAGE=null;ti.DEFAULT_MAPPING=Bc;ti.DEFAULT_ANISOTROPY=1;var he=class{static{this.prototype.isVector4=!0}constructor(t=0,e=0,i=0,s=1){this.x=t,this.y=e,this.z=i,this.w=s}get width(){return this.z}set width(t){this.z=t}get height(){return this.w}set height(t){this.w=t}set(t,e,i,s){return this.x=t,this.y=e,this.z=i,this.w=s,this}setScalar(t){return this.x=t,this.y=t,this.z=t,this.w=t,this}setX(t){return this.x=t,this}setY(t){return this.y=t,this}setZ(t){return this.z=t,this}setW(t){return this.w=t,this}setComponent(t,e){switch(t){case 0:this.x=e;break;case 1:this.y=e;break;case 2:this.z=e;break;case 3:this.w=e;break;default:throw new Error("THREE.Vector4: index is out of range: "+t)}return this}getComponent(t){switch(t){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+t)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(t){return this.x=t.x,this.y=t.y,this.z=t.z,this.w=t.w!==void 0?t.w:1,this}add(t){return this.x+=t.x,this.y+=t.y,this.z+=t.z,this.w+=t.w,this}addScalar(t){return this.x+=t,this.y+=t,this.z+=t,this.w+=t,this}addVectors(t,e){return this.x=t.x+e.x,this.y=t.y+e.y,this.z=t.z+e.z,this.w=t.w+e.w,this}addScaledVector(t,e){return this.x+=t.x*e,this.y+=t.y*e,this.z+=t.z*e,this.w+=t.w*e,this}sub(t){return this.x-=t.x,this.y-=t.y,this.z-=t.z,this.w-=t.w,this}subScalar(t){return this.x-=t,this.y-=t,this.z-=t,this.w-=t,this}subVectors(t,e){return this.x=t.x-e.x,this.y=t.y-e.y,this.z=t.z-e.z,this.w=t.w-e.w,this}multiply(t){return this.x*=t.x,this.y*=t.y,this.z*=t.z,this.w*=t.w,this}multiplyScalar(t){return this.x*=t,this.y*=t,this.z*=t,this.w*=t,this}applyMatrix4(t){let e=this.x,i=this.y,s=this.z,r=this.w,o=t.elements;return this.x=o[0]*e+o[4]*i+o[8]*s+o[12]*r,this.y=o[1]*e+o[5]*i+o[9]*s+o[13]*r,this.z=o[2]*e+o[6]*i+o[10]*s+o[14]*r,this.w=o[3]*e+o[7]*i+o[11]*s+o[15]*r,this}divide(t){return this.x/=t.x,this.y/=t.y,this.z/=t.z,this.w/=t.w,this}divideScalar(t){return this.multiplyScalar(1/t)}setAxisAngleFromQuaternion(t){this.w=2*Math.acos(t.w);let e=Math.sqrt(1-t.w*t.w);return e<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=t.x/e,this.y=t.y/e,this.z=t.z/e),this}setAxisAngleFromRotationMatrix(t){let e,i,s,r,l=t.elements,c=l[0],h=l[4],u=l[8],d=l[1],f=l[5],p=l[9],_=l[2],g=l[6],m=l[10];if(Math.abs(h-d)<.01&&Math.abs(u-_)<.01&&Math.abs(p-g)<.01){if(Math.abs(h+d)<.1&&Math.abs(u+_)<.1&&Math.abs(p+g)<.1&&Math.abs(c+f+m-3)<.1)return this.set(1,0,0,0),this;e=Math.PI;let S=(c+1)/2,w=(f+1)/2,E=(m+1)/2,T=(h+d)/4,x=(u+_)/4,M=(p+g)/4;return S>w&&S>E?S<.01?(i=0,s=.707106781,r=.707106781):(i=Math.sqrt(S),s=T/i,r=x/i):w>E?w<.01?(i=.707106781,s=0,r=.707106781):(s=Math.sqrt(w),i=T/s,r=M/s):E<.01?(i=.707106781,s=.707106781,r=0):(r=Math.sqrt(E),i=x/r,s=M/r),this.set(i,s,r,e),this}let b=Math.sqrt((g-p)*(g-p)+(u-_)*(u-_)+(d-h)*(d-h));return Math.abs(b)<.001&&(b=1),this.x=(g-p)/b,this.y=(u-_)/b,this.z=(d-h)/b,this.w=Math.acos((c+f+m-1)/2),this}setFromMatrixPosition(t){let e=t.elements;return this.x=e[12],this.y=e[13],this.z=e[14],this.w=e[15],this}min(t){return this.x=Math.min(this.x,t.x),this.y=Math.min(this.y,t.y),this.z=Math.min(this.z,t.z),this.w=Math.min(this.w,t.w),this}max(t){return this.x=Math.max(this.x,t.x),this.y=Math.max(this.y,t.y),this.z=Math.max(this.z,t.z),this.w=Math.max(this.w,t.w),this}clamp(t,e){return this.x=Ht(this.x,t.x,e.x),this.y=Ht(this.y,t.y,e.y),this.z=Ht(this.z,t.z,e.z),this.w=Ht(this.w,t.w,e.w),this}clampScalar(t,e){return this.x=Ht(this.x,t,e),this.y=Ht(this.y,t,e),this.z=Ht(this.z,t,e),this.w=Ht(this.w,t,e),this}clampLength(t,e){let i=this.length();return this.divideScalar(i||1).multiplyScalar(Ht(i,t,e))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(t){return this.x*t.x+this.y*t.y+this.z*t.z+this.w*t.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(t){return this.normalize().multiplyScalar(t)}lerp(t,e){return this.x+=(t.x-this.x)*e,this.y+=(t.y-this.y)*e,this.z+=(t.z-this.z)*e,this.w+=(t.w-this.w)*e,this}lerpVectors(t,e,i){return this.x=t.x+(e.x-t.x)*i,this.y=t.y+(e.y-t.y)*i,this.z=t.z+(e.z-t.z)*i,this.w=t.w+(e.w-t.w)*i,this}equals(t){return t.x===this.x&&t.y===this.y&&t.z===this.z&&t.w===this.w}fromArray(t,e=0){return this.x=t[e],this.y=t[e+1],this.z=t[e+2],this.w=t[e+3],this}toArray(t=[],e=0){return t[e]=this.x,t[e+1]=this.y,t[e+2]=this.z,t[e+3]=this.w,t}fromBufferAttribute(t,e){return this.x=t.getX(e),this.y=t.getY(e),this.z=t.getZ(e),this.w=t.getW(e),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}},qo=class extends Si{constructor(t=1,e=1,i={}){super(),i=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Ze,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},i),this.isRenderTarget=!0,this.width=t,this.height=e,this.depth=i.depth,this.scissor=new he(0,0,t,e),this.scissorTest=!1,this.viewport=new he(0,0,t,e),this.textures=[];let s=i.count;for(let r=0;r<s;r++)this.textures[r]=new ti({width:t,height:e,depth:i.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(i),this.depthBuffer=i.depthBuffer,this.stencilBuffer=i.stencilBuffer,this.resolveColorBuffer=i.resolveColorBuffer,this.resolveDepthBuffer=i.resolveDepthBuffer,this.resolveStencilBuffer=i.resolveStencilBuffer,this.storeMultisampledColorBuffer=i.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=i.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=i.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=i.depthTexture,this.samples=i.samples,this.multiview=i.multiview,this.useArrayDepthTexture=i.useArrayDepthTexture}_setTextureOptions(t={}){let e={minFilter:Ze,generateMipmaps:!1,flipY:!1,internalFormat:null};t.mapping!==void 0&&(e.mapping=t.mapping),t.wrapS!==void 0&&(e.wrapS=t.wrapS),t.wrapT!==void 0&&(e.wrapT=t.wrapT),t.wrapR!==void 0&&(e.wrapR=t.wrapR),t.magFilter!==void 0&&(e.magFilter=t.magFilter),t.minFilter!==void 0&&(e.minFilter=t.minFilter),t.format!==void 0&&(e.format=t.format),t.type!==void 0&&(e.type=t.type),t.anisotropy!==void 0&&(e.anisotropy=t.anisotropy),t.colorSpace!==void 0&&(e.colorSpace=t.colorSpace),t.flipY!==void 0&&(e.flipY=t.flipY),t.generateMipmaps!==void 0&&(e.generateMipmaps=t.generateMipmaps),t.mipmapsAutoUpdate!==void 0&&(e.mipmapsAutoUpdate=t.mipmapsAutoUpdate),t.internalFormat!==void 0&&(e.internalFormat=t.internalFormat);for(let i=0;i<this.textures.length;i++)this.textures[i].setValues(e)}get texture(){return this.textures[0]}set texture(t){this.textures[0]=t}set depthTexture(t){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),t!==null&&t.renderTarget===null&&(t.renderTarget=this),this._depthTexture=t}get depthTexture(){return this._depthTexture}setSize(t,e,i=1){if(this.width!==t||this.height!==e||this.depth!==i){this.width=t,this.height=e,this.depth=i;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=t,this.textures[s].image.height=e,this.textures[s].image.depth=i,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,t,e),this.scissor.set(0,0,t,e)}clone(){return new this.constructor().copy(this)}copy(t){this.width=t.width,this.height=t.height,this.depth=t.depth,this.scissor.copy(t.scissor),this.scissorTest=t.scissorTest,this.viewport.copy(t.viewport),this.textures.length=0;for(let e=0,i=t.textures.length;e<i;e++){this.textures[e]=t.textures[e].clone(),this.textures[e].isRenderTargetTexture=!0,this.textures[e].renderTarget=this;let s=Object.assign({},t.textures[e].image);this.textures[e].source=new bs(s)}if(this.depthBuffer=t.depthBuffer,this.stencilBuffer=t.stencilBuffer,this.resolveColorBuffer=t.resolveColorBuffer,this.resolveDepthBuffer=t.resolveDepthBuffer,this.resolveStencilBuffer=t.resolveStencilBuffer,this.storeMultisampledColorBuffer=t.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=t.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=t.storeMultisampledStencilBuffer,t.depthTexture!==null)if(t.depthTexture.renderTarget===t){let e=t.depthTexture.clone();e.renderTarget=null,this.depthTexture=e}else this.depthTexture=t.depthTexture;else this.depthTexture=null;return this.samples=t.samples,this.multiview=t.multiview,this.useArrayDepthTexture=t.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},Ke=class extends qo{constructor(t=1,e=1,i={}){super(t,e,i),this.isWebGLRenderTarget=!0}},ur=class extends ti{constructor(t=null,e=1,i=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Ue,this.minFilter=Ue,this.wrapR=Li,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}addLayerUpdate(t){this.layerUpdates.add(t)}clearLayerUpdates(){this.layerUpdates.clear()}};var $o=class extends ti{constructor(t=null,e=1,i=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:t,width:e,height:i,depth:s},this.magFilter=Ue,this.minFilter=Ue,this.wrapR=Li,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(t){return super.copy(t),this.wrapR=t.wrapR,this}};var $t=class n{static{this.prototype.isMatrix4=!0}constructor(t,e,i,s,r,o,a,l,c,h,u,d,f,p,_,g){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],t!==void 0&&this.set(t,e,i,s,r,o,a,l,c,h,u,d,f,p,_,g)}set(t,e,i,s,r,o,a,l,c,h,u,d,f,p,_,g){let m=this.elements;return m[0]=t,m[4]=e,m[8]=i,m[12]=s,m[1]=r,m[5]=o,m[9]=a,m[13]=l,m[2]=c,m[6]=h,m[10]=u,m[14]=d,m[3]=f,m[7]=p,m[11]=_,m[15]=g,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new n().fromArray(this.elements)}copy(t){let e=this.elements,i=t.elements;return e[0]=i[0],e[1]=i[1],e[2]=i[2],e[3]=i[3],e[4]=i[4],e[5]=i[5],e[6]=i[6],e[7]=i[7],e[8]=i[8],e[9]=i[9],e[10]=i[10],e[11]=i[11],e[12]=i[12],e[13]=i[13],e[14]=i[14],e[15]=i[15],this}copyPosition(t){let e=this.elements,i=t.elements;return e[12]=i[12],e[13]=i[13],e[14]=i[14],this}setFromMatrix3(t){let e=t.elements;return this.set(e[0],e[3],e[6],0,e[1],e[4],e[7],0,e[2],e[5],e[8],0,0,0,0,1),this}extractBasis(t,e,i){return this.determinantAffine()===0?(t.set(1,0,0),e.set(0,1,0),i.set(0,0,1),this):(t.setFromMatrixColumn(this,0),e.setFromMatrixColumn(this,1),i.setFromMatrixColumn(this,2),this)}makeBasis(t,e,i){return this.set(t.x,e.x,i.x,0,t.y,e.y,i.y,0,t.z,e.z,i.z,0,0,0,0,1),this}extractRotation(t){if(t.determinantAffine()===0)return this.identity();let e=this.elements,i=t.elements,s=1/ns.setFromMatrixColumn(t,0).length(),r=1/ns.setFromMatrixColumn(t,1).length(),o=1/ns.setFromMatrixColumn(t,2).length();return e[0]=i[0]*s,e[1]=i[1]*s,e[2]=i[2]*s,e[3]=0,e[4]=i[4]*r,e[5]=i[5]*r,e[6]=i[6]*r,e[7]=0,e[8]=i[8]*o,e[9]=i[9]*o,e[10]=i[10]*o,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromEuler(t){let e=this.elements,i=t.x,s=t.y,r=t.z,o=Math.cos(i),a=Math.sin(i),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),u=Math.sin(r);if(t.order==="XYZ"){let d=o*h,f=o*u,p=a*h,_=a*u;e[0]=l*h,e[4]=-l*u,e[8]=c,e[1]=f+p*c,e[5]=d-_*c,e[9]=-a*l,e[2]=_-d*c,e[6]=p+f*c,e[10]=o*l}else if(t.order==="YXZ"){let d=l*h,f=l*u,p=c*h,_=c*u;e[0]=d+_*a,e[4]=p*a-f,e[8]=o*c,e[1]=o*u,e[5]=o*h,e[9]=-a,e[2]=f*a-p,e[6]=_+d*a,e[10]=o*l}else if(t.order==="ZXY"){let d=l*h,f=l*u,p=c*h,_=c*u;e[0]=d-_*a,e[4]=-o*u,e[8]=p+f*a,e[1]=f+p*a,e[5]=o*h,e[9]=_-d*a,e[2]=-o*c,e[6]=a,e[10]=o*l}else if(t.order==="ZYX"){let d=o*h,f=o*u,p=a*h,_=a*u;e[0]=l*h,e[4]=p*c-f,e[8]=d*c+_,e[1]=l*u,e[5]=_*c+d,e[9]=f*c-p,e[2]=-c,e[6]=a*l,e[10]=o*l}else if(t.order==="YZX"){let d=o*l,f=o*c,p=a*l,_=a*c;e[0]=l*h,e[4]=_-d*u,e[8]=p*u+f,e[1]=u,e[5]=o*h,e[9]=-a*h,e[2]=-c*h,e[6]=f*u+p,e[10]=d-_*u}else if(t.order==="XZY"){let d=o*l,f=o*c,p=a*l,_=a*c;e[0]=l*h,e[4]=-u,e[8]=c*h,e[1]=d*u+_,e[5]=o*h,e[9]=f*u-p,e[2]=p*u-f,e[6]=a*h,e[10]=_*u+d}return e[3]=0,e[7]=0,e[11]=0,e[12]=0,e[13]=0,e[14]=0,e[15]=1,this}makeRotationFromQuaternion(t){return this.compose($m,t,Ym)}lookAt(t,e,i){let s=this.elements;return ri.subVectors(t,e),ri.lengthSq()===0&&(ri.z=1),ri.normalize(),on.crossVectors(i,ri),on.lengthSq()===0&&(Math.abs(i.z)===1?ri.x+=1e-4:ri.z+=1e-4,ri.normalize(),on.crossVectors(i,ri)),on.normalize(),co.crossVectors(ri,on),s[0]=on.x,s[4]=co.x,s[8]=ri.x,s[1]=on.y,s[5]=co.y,s[9]=ri.y,s[2]=on.z,s[6]=co.z,s[10]=ri.z,this}multiply(t){return this.multiplyMatrices(this,t)}premultiply(t){return this.multiplyMatrices(t,this)}multiplyMatrices(t,e){let i=t.elements,s=e.elements,r=this.elements,o=i[0],a=i[4],l=i[8],c=i[12],h=i[1],u=i[5],d=i[9],f=i[13],p=i[2],_=i[6],g=i[10],m=i[14],b=i[3],S=i[7],w=i[11],E=i[15],T=s[0],x=s[4],M=s[8],D=s[12],P=s[1],U=s[5],F=s[9],W=s[13],I=s[2],H=s[6],$=s[10],G=s[14],et=s[3],X=s[7],Q=s[11],tt=s[15];return r[0]=o*T+a*P+l*I+c*et,r[4]=o*x+a*U+l*H+c*X,r[8]=o*M+a*F+l*$+c*Q,r[12]=o*D+a*W+l*G+c*tt,r[1]=h*T+u*P+d*I+f*et,r[5]=h*x+u*U+d*H+f*X,r[9]=h*M+u*F+d*$+f*Q,r[13]=h*D+u*W+d*G+f*tt,r[2]=p*T+_*P+g*I+m*et,r[6]=p*x+_*U+g*H+m*X,r[10]=p*M+_*F+g*$+m*Q,r[14]=p*D+_*W+g*G+m*tt,r[3]=b*T+S*P+w*I+E*et,r[7]=b*x+S*U+w*H+E*X,r[11]=b*M+S*F+w*$+E*Q,r[15]=b*D+S*W+w*G+E*tt,this}multiplyScalar(t){let e=this.elements;return e[0]*=t,e[4]*=t,e[8]*=t,e[12]*=t,e[1]*=t,e[5]*=t,e[9]*=t,e[13]*=t,e[2]*=t,e[6]*=t,e[10]*=t,e[14]*=t,e[3]*=t,e[7]*=t,e[11]*=t,e[15]*=t,this}determinant(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[12],o=t[1],a=t[5],l=t[9],c=t[13],h=t[2],u=t[6],d=t[10],f=t[14],p=t[3],_=t[7],g=t[11],m=t[15],b=l*f-c*d,S=a*f-c*u,w=a*d-l*u,E=o*f-c*h,T=o*d-l*h,x=o*u-a*h;return e*(_*b-g*S+m*w)-i*(p*b-g*E+m*T)+s*(p*S-_*E+m*x)-r*(p*w-_*T+g*x)}determinantAffine(){let t=this.elements,e=t[0],i=t[4],s=t[8],r=t[1],o=t[5],a=t[9],l=t[2],c=t[6],h=t[10];return e*(o*h-a*c)-i*(r*h-a*l)+s*(r*c-o*l)}transpose(){let t=this.elements,e;return e=t[1],t[1]=t[4],t[4]=e,e=t[2],t[2]=t[8],t[8]=e,e=t[6],t[6]=t[9],t[9]=e,e=t[3],t[3]=t[12],t[12]=e,e=t[7],t[7]=t[13],t[13]=e,e=t[11],t[11]=t[14],t[14]=e,this}setPosition(t,e,i){let s=this.elements;return t.isVector3?(s[12]=t.x,s[13]=t.y,s[14]=t.z):(s[12]=t,s[13]=e,s[14]=i),this}invert(){let t=this.elements,e=t[0],i=t[1],s=t[2],r=t[3],o=t[4],a=t[5],l=t[6],c=t[7],h=t[8],u=t[9],d=t[10],f=t[11],p=t[12],_=t[13],g=t[14],m=t[15],b=e*a-i*o,S=e*l-s*o,w=e*c-r*o,E=i*l-s*a,T=i*c-r*a,x=s*c-r*l,M=h*_-u*p,D=h*g-d*p,P=h*m-f*p,U=u*g-d*_,F=u*m-f*_,W=d*m-f*g,I=b*W-S*F+w*U+E*P-T*D+x*M;if(I===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let H=1/I;return t[0]=(a*W-l*F+c*U)*H,t[1]=(s*F-i*W-r*U)*H,t[2]=(_*x-g*T+m*E)*H,t[3]=(d*T-u*x-f*E)*H,t[4]=(l*P-o*W-c*D)*H,t[5]=(e*W-s*P+r*D)*H,t[6]=(g*w-p*x-m*S)*H,t[7]=(h*x-d*w+f*S)*H,t[8]=(o*F-a*P+c*M)*H,t[9]=(i*P-e*F-r*M)*H,t[10]=(p*T-_*w+m*b)*H,t[11]=(u*w-h*T-f*b)*H,t[12]=(a*D-o*U-l*M)*H,t[13]=(e*U-i*D+s*M)*H,t[14]=(_*S-p*E-g*b)*H,t[15]=(h*E-u*S+d*b)*H,this}scale(t){let e=this.elements,i=t.x,s=t.y,r=t.z;return e[0]*=i,e[4]*=s,e[8]*=r,e[1]*=i,e[5]*=s,e[9]*=r,e[2]*=i,e[6]*=s,e[10]*=r,e[3]*=i,e[7]*=s,e[11]*=r,this}getMaxScaleOnAxis(){let t=this.elements,e=t[0]*t[0]+t[1]*t[1]+t[2]*t[2],i=t[4]*t[4]+t[5]*t[5]+t[6]*t[6],s=t[8]*t[8]+t[9]*t[9]+t[10]*t[10];return Math.sqrt(Math.max(e,i,s))}makeTranslation(t,e,i){return t.isVector3?this.set(1,0,0,t.x,0,1,0,t.y,0,0,1,t.z,0,0,0,1):this.set(1,0,0,t,0,1,0,e,0,0,1,i,0,0,0,1),this}makeRotationX(t){let e=Math.cos(t),i=Math.sin(t);return this.set(1,0,0,0,0,e,-i,0,0,i,e,0,0,0,0,1),this}makeRotationY(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,0,i,0,0,1,0,0,-i,0,e,0,0,0,0,1),this}makeRotationZ(t){let e=Math.cos(t),i=Math.sin(t);return this.set(e,-i,0,0,i,e,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(t,e){let i=Math.cos(e),s=Math.sin(e),r=1-i,o=t.x,a=t.y,l=t.z,c=r*o,h=r*a;return this.set(c*o+i,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+i,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+i,0,0,0,0,1),this}makeScale(t,e,i){return this.set(t,0,0,0,0,e,0,0,0,0,i,0,0,0,0,1),this}makeShear(t,e,i,s,r,o){return this.set(1,i,r,0,t,1,o,0,e,s,1,0,0,0,0,1),this}compose(t,e,i){let s=this.elements,r=e._x,o=e._y,a=e._z,l=e._w,c=r+r,h=o+o,u=a+a,d=r*c,f=r*h,p=r*u,_=o*h,g=o*u,m=a*u,b=l*c,S=l*h,w=l*u,E=i.x,T=i.y,x=i.z;return s[0]=(1-(_+m))*E,s[1]=(f+w)*E,s[2]=(p-S)*E,s[3]=0,s[4]=(f-w)*T,s[5]=(1-(d+m))*T,s[6]=(g+b)*T,s[7]=0,s[8]=(p+S)*x,s[9]=(g-b)*x,s[10]=(1-(d+_))*x,s[11]=0,s[12]=t.x,s[13]=t.y,s[14]=t.z,s[15]=1,this}decompose(t,e,i){let s=this.elements;t.x=s[12],t.y=s[13],t.z=s[14];let r=this.determinantAffine();if(r===0)return i.set(1,1,1),e.identity(),this;let o=ns.set(s[0],s[1],s[2]).length(),a=ns.set(s[4],s[5],s[6]).length(),l=ns.set(s[8],s[9],s[10]).length();r<0&&(o=-o),bi.copy(this);let c=1/o,h=1/a,u=1/l;return bi.elements[0]*=c,bi.elements[1]*=c,bi.elements[2]*=c,bi.elements[4]*=h,bi.elements[5]*=h,bi.elements[6]*=h,bi.elements[8]*=u,bi.elements[9]*=u,bi.elements[10]*=u,e.setFromRotationMatrix(bi),i.x=o,i.y=a,i.z=l,this}makePerspective(t,e,i,s,r,o,a=gi,l=!1){let c=this.elements,h=2*r/(e-t),u=2*r/(i-s),d=(e+t)/(e-t),f=(i+s)/(i-s),p,_;if(l)p=r/(o-r),_=o*r/(o-r);else if(a===gi)p=-(o+r)/(o-r),_=-2*o*r/(o-r);else if(a===_s)p=-o/(o-r),_=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=d,c[12]=0,c[1]=0,c[5]=u,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=_,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(t,e,i,s,r,o,a=gi,l=!1){let c=this.elements,h=2/(e-t),u=2/(i-s),d=-(e+t)/(e-t),f=-(i+s)/(i-s),p,_;if(l)p=1/(o-r),_=o/(o-r);else if(a===gi)p=-2/(o-r),_=-(o+r)/(o-r);else if(a===_s)p=-1/(o-r),_=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=d,c[1]=0,c[5]=u,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=p,c[14]=_,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(t){let e=this.elements,i=t.elements;for(let s=0;s<16;s++)if(e[s]!==i[s])return!1;return!0}fromArray(t,e=0){for(let i=0;i<16;i++)this.elements[i]=t[i+e];return this}toArray(t=[],e=0){let i=this.elements;return t[e]=i[0],t[e+1]=i[1],t[e+2]=i[2],t[e+3]=i[3],t[e+4]=i[4],t[e+5]=i[5],t[e+6]=i[6],t[e+7]=i[7],t[e+8]=i[8],t[e+9]=i[9],t[e+10]=i[10],t[e+11]=i[11],t[e+12]=i[12],t[e+13]=i[13],t[e+14]=i[14],t[e+15]=i[15],t}},ns=new N,bi=new $t,$m=new N(0,0,0),Ym=new N(1,1,1),on=new N,co=new N,ri=new N,gu=new $t,xu=new Je,Xi=class n{constructor(t=0,e=0,i=0,s=n.DEFAULT_ORDER){this.isEuler=!0,this._x=t,this._y=e,this._z=i,this._order=s}get x(){return this._x}set x(t){this._x=t,this._onChangeCallback()}get y(){return this._y}set y(t){this._y=t,this._onChangeCallback()}get z(){return this._z}set z(t){this._z=t,this._onChangeCallback()}get order(){return this._order}set order(t){this._order=t,this._onChangeCallback()}set(t,e,i,s=this._order){return this._x=t,this._y=e,this._z=i,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(t){return this._x=t._x,this._y=t._y,this._z=t._z,this._order=t._order,this._onChangeCallback(),this}setFromRotationMatrix(t,e=this._order,i=!0){let s=t.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],u=s[2],d=s[6],f=s[10];switch(e){case"XYZ":this._y=Math.asin(Ht(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(d,c),this._z=0);break;case"YXZ":this._x=Math.asin(-Ht(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-u,r),this._z=0);break;case"ZXY":this._x=Math.asin(Ht(d,-1,1)),Math.abs(d)<.9999999?(this._y=Math.atan2(-u,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-Ht(u,-1,1)),Math.abs(u)<.9999999?(this._x=Math.atan2(d,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(Ht(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-u,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-Ht(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(d,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:At("Euler: .setFromRotationMatrix() encountered an unknown order: "+e)}return this._order=e,i===!0&&this._onChangeCallback(),this}setFromQuaternion(t,e,i){return gu.makeRotationFromQuaternion(t),this.setFromRotationMatrix(gu,e,i)}setFromVector3(t,e=this._order){return this.set(t.x,t.y,t.z,e)}reorder(t){return xu.setFromEuler(this),this.setFromQuaternion(xu,t)}equals(t){return t._x===this._x&&t._y===this._y&&t._z===this._z&&t._order===this._order}fromArray(t){return this._x=t[0],this._y=t[1],this._z=t[2],t[3]!==void 0&&(this._order=t[3]),this._onChangeCallback(),this}toArray(t=[],e=0){return t[e]=this._x,t[e+1]=this._y,t[e+2]=this._z,t[e+3]=this._order,t}_onChange(t){return this._onChangeCallback=t,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};Xi.DEFAULT_ORDER="XYZ";var dr=class{constructor(){this.mask=1}set(t){this.mask=(1<<t|0)>>>0}enable(t){this.mask|=1<<t|0}enableAll(){this.mask=-1}toggle(t){this.mask^=1<<t|0}disable(t){this.mask&=~(1<<t|0)}disableAll(){this.mask=0}test(t){return(this.mask&t.mask)!==0}isEnabled(t){return(this.mask&(1<<t|0))!==0}},Zm=0,_u=new N,ss=new Je,Bi=new $t,ho=new N,Ks=new N,Jm=new N,Km=new Je,yu=new N(1,0,0),vu=new N(0,1,0),bu=new N(0,0,1),wu={type:"added"},jm={type:"removed"},rs={type:"childadded",child:null},jl={type:"childremoved",child:null},Be=class n extends Si{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:Zm++}),this.uuid=Is(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=n.DEFAULT_UP.clone();let t=new N,e=new Xi,i=new Je,s=new N(1,1,1);function r(){i.setFromEuler(e,!1)}function o(){e.setFromQuaternion(i,void 0,!1)}e._onChange(r),i._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:t},rotation:{configurable:!0,enumerable:!0,value:e},quaternion:{configurable:!0,enumerable:!0,value:i},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new $t},normalMatrix:{value:new Nt}}),this.matrix=new $t,this.matrixWorld=new $t,this.matrixAutoUpdate=n.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=n.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new dr,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(t){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(t),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(t){return this.quaternion.premultiply(t),this}setRotationFromAxisAngle(t,e){this.quaternion.setFromAxisAngle(t,e)}setRotationFromEuler(t){this.quaternion.setFromEuler(t,!0)}setRotationFromMatrix(t){this.quaternion.setFromRotationMatrix(t)}setRotationFromQuaternion(t){this.quaternion.copy(t)}rotateOnAxis(t,e){return ss.setFromAxisAngle(t,e),this.quaternion.multiply(ss),this}rotateOnWorldAxis(t,e){return ss.setFromAxisAngle(t,e),this.quaternion.premultiply(ss),this}rotateX(t){return this.rotateOnAxis(yu,t)}rotateY(t){return this.rotateOnAxis(vu,t)}rotateZ(t){return this.rotateOnAxis(bu,t)}translateOnAxis(t,e){return _u.copy(t).applyQuaternion(this.quaternion),this.position.add(_u.multiplyScalar(e)),this}translateX(t){return this.translateOnAxis(yu,t)}translateY(t){return this.translateOnAxis(vu,t)}translateZ(t){return this.translateOnAxis(bu,t)}localToWorld(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(this.matrixWorld)}worldToLocal(t){return this.updateWorldMatrix(!0,!1),t.applyMatrix4(Bi.copy(this.matrixWorld).invert())}lookAt(t,e,i){t.isVector3?ho.copy(t):ho.set(t,e,i);let s=this.parent;this.updateWorldMatrix(!0,!1),Ks.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?Bi.lookAt(Ks,ho,this.up):Bi.lookAt(ho,Ks,this.up),this.quaternion.setFromRotationMatrix(Bi),s&&(Bi.extractRotation(s.matrixWorld),ss.setFromRotationMatrix(Bi),this.quaternion.premultiply(ss.invert()))}add(t){if(arguments.length>1){for(let e=0;e<arguments.length;e++)this.add(arguments[e]);return this}return t===this?(Dt("Object3D.add: object can't be added as a child of itself.",t),this):(t&&t.isObject3D?(t.removeFromParent(),t.parent=this,this.children.push(t),t.dispatchEvent(wu),rs.child=t,this.dispatchEvent(rs),rs.child=null):Dt("Object3D.add: object not an instance of THREE.Object3D.",t),this)}remove(t){if(arguments.length>1){for(let i=0;i<arguments.length;i++)this.remove(arguments[i]);return this}let e=this.children.indexOf(t);return e!==-1&&(t.parent=null,this.children.splice(e,1),t.dispatchEvent(jm),jl.child=t,this.dispatchEvent(jl),jl.child=null),this}removeFromParent(){let t=this.parent;return t!==null&&t.remove(this),this}clear(){return this.remove(...this.children)}attach(t){return this.updateWorldMatrix(!0,!1),Bi.copy(this.matrixWorld).invert(),t.parent!==null&&(t.parent.updateWorldMatrix(!0,!1),Bi.multiply(t.parent.matrixWorld)),t.applyMatrix4(Bi),t.removeFromParent(),t.parent=this,this.children.push(t),t.updateWorldMatrix(!1,!0),t.dispatchEvent(wu),rs.child=t,this.dispatchEvent(rs),rs.child=null,this}getObjectById(t){return this.getObjectByProperty("id",t)}getObjectByName(t){return this.getObjectByProperty("name",t)}getObjectByProperty(t,e){if(this[t]===e)return this;for(let i=0,s=this.children.length;i<s;i++){let o=this.children[i].getObjectByProperty(t,e);if(o!==void 0)return o}}getObjectsByProperty(t,e,i=[]){this[t]===e&&i.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(t,e,i);return i}getWorldPosition(t){return this.updateWorldMatrix(!0,!1),t.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ks,t,Jm),t}getWorldScale(t){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Ks,Km,t),t}getWorldDirection(t){this.updateWorldMatrix(!0,!1);let e=this.matrixWorld.elements;return t.set(e[8],e[9],e[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(t){t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverse(t)}traverseVisible(t){if(this.visible===!1)return;t(this);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].traverseVisible(t)}traverseAncestors(t){let e=this.parent;e!==null&&(t(e),e.traverseAncestors(t))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let t=this.pivot;if(t!==null){let e=t.x,i=t.y,s=t.z,r=this.matrix.elements;r[12]+=e-r[0]*e-r[4]*i-r[8]*s,r[13]+=i-r[1]*e-r[5]*i-r[9]*s,r[14]+=s-r[2]*e-r[6]*i-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(t){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||t)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,t=!0);let e=this.children;for(let i=0,s=e.length;i<s;i++)e[i].updateMatrixWorld(t)}updateWorldMatrix(t,e,i=!1){let s=this.parent;if(t===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||i)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,i=!0),e===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,i)}}toJSON(t){let e=t===void 0||typeof t=="string",i={};e&&(t={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},i.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(t),s.indirectTexture=this._indirectTexture.toJSON(t),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(t)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(t)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(t).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(t).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(t.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let u=l[c];r(t.shapes,u)}else r(t.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(t.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(t.materials,this.material[l]));s.material=a}else s.material=r(t.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(t).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(t.animations,l))}}if(e){let a=o(t.geometries),l=o(t.materials),c=o(t.textures),h=o(t.images),u=o(t.shapes),d=o(t.skeletons),f=o(t.animations),p=o(t.nodes);a.length>0&&(i.geometries=a),l.length>0&&(i.materials=l),c.length>0&&(i.textures=c),h.length>0&&(i.images=h),u.length>0&&(i.shapes=u),d.length>0&&(i.skeletons=d),f.length>0&&(i.animations=f),p.length>0&&(i.nodes=p)}return i.object=s,i;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(t){return new this.constructor().copy(this,t)}copy(t,e=!0){if(this.name=t.name,this.up.copy(t.up),this.position.copy(t.position),this.rotation.order=t.rotation.order,this.quaternion.copy(t.quaternion),this.scale.copy(t.scale),this.pivot=t.pivot!==null?t.pivot.clone():null,this.matrix.copy(t.matrix),this.matrixWorld.copy(t.matrixWorld),this.matrixAutoUpdate=t.matrixAutoUpdate,this.matrixWorldAutoUpdate=t.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=t.matrixWorldNeedsUpdate,this.layers.mask=t.layers.mask,this.visible=t.visible,this.castShadow=t.castShadow,this.receiveShadow=t.receiveShadow,this.frustumCulled=t.frustumCulled,this.renderOrder=t.renderOrder,this.static=t.static,this.animations=t.animations.slice(),this.userData=JSON.parse(JSON.stringify(t.userData)),e===!0)for(let i=0;i<t.children.length;i++){let s=t.children[i];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};Be.DEFAULT_UP=new N(0,1,0);Be.DEFAULT_MATRIX_AUTO_UPDATE=!0;Be.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var ge=class extends Be{constructor(){super(),this.isGroup=!0,this.type="Group"}},Qm={type:"move"},ws=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new ge,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new ge,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new N,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new N),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new ge,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new N,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new N,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(t){return this._targetRay!==null&&this._targetRay.dispatchEvent(t),this._grip!==null&&this._grip.dispatchEvent(t),this._hand!==null&&this._hand.dispatchEvent(t),this}connect(t){if(t&&t.hand){let e=this._hand;if(e)for(let i of t.hand.values())this._getHandJoint(e,i)}return this.dispatchEvent({type:"connected",data:t}),this}disconnect(t){return this.dispatchEvent({type:"disconnected",data:t}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(t,e,i){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(t&&e.session.visibilityState!=="visible-blurred"){if(c&&t.hand){o=!0;for(let _ of t.hand.values()){let g=e.getJointPose(_,i),m=this._getHandJoint(c,_);g!==null&&(m.matrix.fromArray(g.transform.matrix),m.matrix.decompose(m.position,m.quaternion,m.scale),m.matrixWorldNeedsUpdate=!0,m.jointRadius=g.radius),m.visible=g!==null}let h=c.joints["index-finger-tip"],u=c.joints["thumb-tip"],d=h.position.distanceTo(u.position),f=.02,p=.005;c.inputState.pinching&&d>f+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:t.handedness,target:this})):!c.inputState.pinching&&d<=f-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:t.handedness,target:this}))}else l!==null&&t.gripSpace&&(r=e.getPose(t.gripSpace,i),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:t,target:this})));a!==null&&(s=e.getPose(t.targetRaySpace,i),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(Qm)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(t,e){if(t.joints[e.jointName]===void 0){let i=new ge;i.matrixAutoUpdate=!1,i.visible=!1,t.joints[e.jointName]=i,t.add(i)}return t.joints[e.jointName]}},Rd={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},an={h:0,s:0,l:0},uo={h:0,s:0,l:0};function Ql(n,t,e){return e<0&&(e+=1),e>1&&(e-=1),e<1/6?n+(t-n)*6*e:e<1/2?t:e<2/3?n+(t-n)*6*(2/3-e):n}var Pt=class{constructor(t,e,i){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(t,e,i)}set(t,e,i){if(e===void 0&&i===void 0){let s=t;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(t,e,i);return this}setScalar(t){return this.r=t,this.g=t,this.b=t,this}setHex(t,e=xe){return t=Math.floor(t),this.r=(t>>16&255)/255,this.g=(t>>8&255)/255,this.b=(t&255)/255,qt.colorSpaceToWorking(this,e),this}setRGB(t,e,i,s=qt.workingColorSpace){return this.r=t,this.g=e,this.b=i,qt.colorSpaceToWorking(this,s),this}setHSL(t,e,i,s=qt.workingColorSpace){if(t=Jc(t,1),e=Ht(e,0,1),i=Ht(i,0,1),e===0)this.r=this.g=this.b=i;else{let r=i<=.5?i*(1+e):i+e-i*e,o=2*i-r;this.r=Ql(o,r,t+1/3),this.g=Ql(o,r,t),this.b=Ql(o,r,t-1/3)}return qt.colorSpaceToWorking(this,s),this}setStyle(t,e=xe){function i(r){r!==void 0&&parseFloat(r)<1&&At("Color: Alpha component of "+t+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(t)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,e);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,e);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return i(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,e);break;default:At("Color: Unknown color model "+t)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(t)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,e);if(o===6)return this.setHex(parseInt(r,16),e);At("Color: Invalid hex color "+t)}else if(t&&t.length>0)return this.setColorName(t,e);return this}setColorName(t,e=xe){let i=Rd[t.toLowerCase()];return i!==void 0?this.setHex(i,e):At("Color: Unknown color "+t),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(t){return this.r=t.r,this.g=t.g,this.b=t.b,this}copySRGBToLinear(t){return this.r=Vi(t.r),this.g=Vi(t.g),this.b=Vi(t.b),this}copyLinearToSRGB(t){return this.r=gs(t.r),this.g=gs(t.g),this.b=gs(t.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(t=xe){return qt.workingToColorSpace(We.copy(this),t),Math.round(Ht(We.r*255,0,255))*65536+Math.round(Ht(We.g*255,0,255))*256+Math.round(Ht(We.b*255,0,255))}getHexString(t=xe){return("000000"+this.getHex(t).toString(16)).slice(-6)}getHSL(t,e=qt.workingColorSpace){qt.workingToColorSpace(We.copy(this),e);let i=We.r,s=We.g,r=We.b,o=Math.max(i,s,r),a=Math.min(i,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let u=o-a;switch(c=h<=.5?u/(o+a):u/(2-o-a),o){case i:l=(s-r)/u+(s<r?6:0);break;case s:l=(r-i)/u+2;break;case r:l=(i-s)/u+4;break}l/=6}return t.h=l,t.s=c,t.l=h,t}getRGB(t,e=qt.workingColorSpace){return qt.workingToColorSpace(We.copy(this),e),t.r=We.r,t.g=We.g,t.b=We.b,t}getStyle(t=xe){qt.workingToColorSpace(We.copy(this),t);let e=We.r,i=We.g,s=We.b;return t!==xe?`color(${t} ${e.toFixed(3)} ${i.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(e*255)},${Math.round(i*255)},${Math.round(s*255)})`}offsetHSL(t,e,i){return this.getHSL(an),this.setHSL(an.h+t,an.s+e,an.l+i)}add(t){return this.r+=t.r,this.g+=t.g,this.b+=t.b,this}addColors(t,e){return this.r=t.r+e.r,this.g=t.g+e.g,this.b=t.b+e.b,this}addScalar(t){return this.r+=t,this.g+=t,this.b+=t,this}sub(t){return this.r=Math.max(0,this.r-t.r),this.g=Math.max(0,this.g-t.g),this.b=Math.max(0,this.b-t.b),this}multiply(t){return this.r*=t.r,this.g*=t.g,this.b*=t.b,this}multiplyScalar(t){return this.r*=t,this.g*=t,this.b*=t,this}lerp(t,e){return this.r+=(t.r-this.r)*e,this.g+=(t.g-this.g)*e,this.b+=(t.b-this.b)*e,this}lerpColors(t,e,i){return this.r=t.r+(e.r-t.r)*i,this.g=t.g+(e.g-t.g)*i,this.b=t.b+(e.b-t.b)*i,this}lerpHSL(t,e){this.getHSL(an),t.getHSL(uo);let i=or(an.h,uo.h,e),s=or(an.s,uo.s,e),r=or(an.l,uo.l,e);return this.setHSL(i,s,r),this}setFromVector3(t){return this.r=t.x,this.g=t.y,this.b=t.z,this}applyMatrix3(t){let e=this.r,i=this.g,s=this.b,r=t.elements;return this.r=r[0]*e+r[3]*i+r[6]*s,this.g=r[1]*e+r[4]*i+r[7]*s,this.b=r[2]*e+r[5]*i+r[8]*s,this}equals(t){return t.r===this.r&&t.g===this.g&&t.b===this.b}fromArray(t,e=0){return this.r=t[e],this.g=t[e+1],this.b=t[e+2],this}toArray(t=[],e=0){return t[e]=this.r,t[e+1]=this.g,t[e+2]=this.b,t}fromBufferAttribute(t,e){return this.r=t.getX(e),this.g=t.getY(e),this.b=t.getZ(e),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},We=new Pt;Pt.NAMES=Rd;var fr=class extends Be{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new Xi,this.environmentIntensity=1,this.environmentRotation=new Xi,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(t,e){return super.copy(t,e),this.background=t.background!==null?t.background.clone():null,this.environment=t.environment!==null?t.environment.clone():null,this.fog=t.fog!==null?t.fog.clone():null,this.backgroundBlurriness=t.backgroundBlurriness,this.backgroundIntensity=t.backgroundIntensity,this.backgroundRotation.copy(t.backgroundRotation),this.environmentIntensity=t.environmentIntensity,this.environmentRotation.copy(t.environmentRotation),this.overrideMaterial=t.overrideMaterial!==null?t.overrideMaterial.clone():null,this.matrixAutoUpdate=t.matrixAutoUpdate,this}toJSON(t){let e=super.toJSON(t);return this.fog!==null&&(e.object.fog=this.fog.toJSON()),e.object.backgroundBlurriness=this.backgroundBlurriness,e.object.backgroundIntensity=this.backgroundIntensity,e.object.backgroundRotation=this.backgroundRotation.toArray(),e.object.environmentIntensity=this.environmentIntensity,e.object.environmentRotation=this.environmentRotation.toArray(),e}},wi=new N,ki=new N,tc=new N,zi=new N,os=new N,as=new N,Mu=new N,ec=new N,ic=new N,nc=new N,sc=new he,rc=new he,oc=new he,un=class n{constructor(t=new N,e=new N,i=new N){this.a=t,this.b=e,this.c=i}static getNormal(t,e,i,s){s.subVectors(i,e),wi.subVectors(t,e),s.cross(wi);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(t,e,i,s,r){wi.subVectors(s,e),ki.subVectors(i,e),tc.subVectors(t,e);let o=wi.dot(wi),a=wi.dot(ki),l=wi.dot(tc),c=ki.dot(ki),h=ki.dot(tc),u=o*c-a*a;if(u===0)return r.set(0,0,0),null;let d=1/u,f=(c*l-a*h)*d,p=(o*h-a*l)*d;return r.set(1-f-p,p,f)}static containsPoint(t,e,i,s){return this.getBarycoord(t,e,i,s,zi)===null?!1:zi.x>=0&&zi.y>=0&&zi.x+zi.y<=1}static getInterpolation(t,e,i,s,r,o,a,l){return this.getBarycoord(t,e,i,s,zi)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,zi.x),l.addScaledVector(o,zi.y),l.addScaledVector(a,zi.z),l)}static getInterpolatedAttribute(t,e,i,s,r,o){return sc.setScalar(0),rc.setScalar(0),oc.setScalar(0),sc.fromBufferAttribute(t,e),rc.fromBufferAttribute(t,i),oc.fromBufferAttribute(t,s),o.setScalar(0),o.addScaledVector(sc,r.x),o.addScaledVector(rc,r.y),o.addScaledVector(oc,r.z),o}static isFrontFacing(t,e,i,s){return wi.subVectors(i,e),ki.subVectors(t,e),wi.cross(ki).dot(s)<0}set(t,e,i){return this.a.copy(t),this.b.copy(e),this.c.copy(i),this}setFromPointsAndIndices(t,e,i,s){return this.a.copy(t[e]),this.b.copy(t[i]),this.c.copy(t[s]),this}setFromAttributeAndIndices(t,e,i,s){return this.a.fromBufferAttribute(t,e),this.b.fromBufferAttribute(t,i),this.c.fromBufferAttribute(t,s),this}clone(){return new this.constructor().copy(this)}copy(t){return this.a.copy(t.a),this.b.copy(t.b),this.c.copy(t.c),this}getArea(){return wi.subVectors(this.c,this.b),ki.subVectors(this.a,this.b),wi.cross(ki).length()*.5}getMidpoint(t){return t.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(t){return n.getNormal(this.a,this.b,this.c,t)}getPlane(t){return t.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(t,e){return n.getBarycoord(t,this.a,this.b,this.c,e)}getInterpolation(t,e,i,s,r){return n.getInterpolation(t,this.a,this.b,this.c,e,i,s,r)}containsPoint(t){return n.containsPoint(t,this.a,this.b,this.c)}isFrontFacing(t){return n.isFrontFacing(this.a,this.b,this.c,t)}intersectsBox(t){return t.intersectsTriangle(this)}closestPointToPoint(t,e){let i=this.a,s=this.b,r=this.c,o,a;os.subVectors(s,i),as.subVectors(r,i),ec.subVectors(t,i);let l=os.dot(ec),c=as.dot(ec);if(l<=0&&c<=0)return e.copy(i);ic.subVectors(t,s);let h=os.dot(ic),u=as.dot(ic);if(h>=0&&u<=h)return e.copy(s);let d=l*u-h*c;if(d<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),e.copy(i).addScaledVector(os,o);nc.subVectors(t,r);let f=os.dot(nc),p=as.dot(nc);if(p>=0&&f<=p)return e.copy(r);let _=f*c-l*p;if(_<=0&&c>=0&&p<=0)return a=c/(c-p),e.copy(i).addScaledVector(as,a);let g=h*p-f*u;if(g<=0&&u-h>=0&&f-p>=0)return Mu.subVectors(r,s),a=(u-h)/(u-h+(f-p)),e.copy(s).addScaledVector(Mu,a);let m=1/(g+_+d);return o=_*m,a=d*m,e.copy(i).addScaledVector(os,o).addScaledVector(as,a)}equals(t){return t.a.equals(this.a)&&t.b.equals(this.b)&&t.c.equals(this.c)}},Di=class{constructor(t=new N(1/0,1/0,1/0),e=new N(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=t,this.max=e}set(t,e){return this.min.copy(t),this.max.copy(e),this}setFromArray(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e+=3)this.expandByPoint(Mi.fromArray(t,e));return this}setFromBufferAttribute(t){this.makeEmpty();for(let e=0,i=t.count;e<i;e++)this.expandByPoint(Mi.fromBufferAttribute(t,e));return this}setFromPoints(t){this.makeEmpty();for(let e=0,i=t.length;e<i;e++)this.expandByPoint(t[e]);return this}setFromCenterAndSize(t,e){let i=Mi.copy(e).multiplyScalar(.5);return this.min.copy(t).sub(i),this.max.copy(t).add(i),this}setFromObject(t,e=!1){return this.makeEmpty(),this.expandByObject(t,e)}clone(){return new this.constructor().copy(this)}copy(t){return this.min.copy(t.min),this.max.copy(t.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(t){return this.isEmpty()?t.set(0,0,0):t.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(t){return this.isEmpty()?t.set(0,0,0):t.subVectors(this.max,this.min)}expandByPoint(t){return this.min.min(t),this.max.max(t),this}expandByVector(t){return this.min.sub(t),this.max.add(t),this}expandByScalar(t){return this.min.addScalar(-t),this.max.addScalar(t),this}expandByObject(t,e=!1){t.updateWorldMatrix(!1,!1);let i=t.geometry;if(i!==void 0){let r=i.getAttribute("position");if(e===!0&&r!==void 0&&t.isInstancedMesh!==!0&&t.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)t.isMesh===!0?t.getVertexPosition(o,Mi):Mi.fromBufferAttribute(r,o),Mi.applyMatrix4(t.matrixWorld),this.expandByPoint(Mi);else t.boundingBox!==void 0?(t.boundingBox===null&&t.computeBoundingBox(),fo.copy(t.boundingBox)):(i.boundingBox===null&&i.computeBoundingBox(),fo.copy(i.boundingBox)),fo.applyMatrix4(t.matrixWorld),this.union(fo)}let s=t.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],e);return this}containsPoint(t){return t.x>=this.min.x&&t.x<=this.max.x&&t.y>=this.min.y&&t.y<=this.max.y&&t.z>=this.min.z&&t.z<=this.max.z}containsBox(t){return this.min.x<=t.min.x&&t.max.x<=this.max.x&&this.min.y<=t.min.y&&t.max.y<=this.max.y&&this.min.z<=t.min.z&&t.max.z<=this.max.z}getParameter(t,e){return e.set((t.x-this.min.x)/(this.max.x-this.min.x),(t.y-this.min.y)/(this.max.y-this.min.y),(t.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(t){return t.max.x>=this.min.x&&t.min.x<=this.max.x&&t.max.y>=this.min.y&&t.min.y<=this.max.y&&t.max.z>=this.min.z&&t.min.z<=this.max.z}intersectsSphere(t){return this.clampPoint(t.center,Mi),Mi.distanceToSquared(t.center)<=t.radius*t.radius}intersectsPlane(t){let e,i;return t.normal.x>0?(e=t.normal.x*this.min.x,i=t.normal.x*this.max.x):(e=t.normal.x*this.max.x,i=t.normal.x*this.min.x),t.normal.y>0?(e+=t.normal.y*this.min.y,i+=t.normal.y*this.max.y):(e+=t.normal.y*this.max.y,i+=t.normal.y*this.min.y),t.normal.z>0?(e+=t.normal.z*this.min.z,i+=t.normal.z*this.max.z):(e+=t.normal.z*this.max.z,i+=t.normal.z*this.min.z),e<=-t.constant&&i>=-t.constant}intersectsTriangle(t){if(this.isEmpty())return!1;this.getCenter(js),po.subVectors(this.max,js),ls.subVectors(t.a,js),cs.subVectors(t.b,js),hs.subVectors(t.c,js),ln.subVectors(cs,ls),cn.subVectors(hs,cs),Pn.subVectors(ls,hs);let e=[0,-ln.z,ln.y,0,-cn.z,cn.y,0,-Pn.z,Pn.y,ln.z,0,-ln.x,cn.z,0,-cn.x,Pn.z,0,-Pn.x,-ln.y,ln.x,0,-cn.y,cn.x,0,-Pn.y,Pn.x,0];return!ac(e,ls,cs,hs,po)||(e=[1,0,0,0,1,0,0,0,1],!ac(e,ls,cs,hs,po))?!1:(mo.crossVectors(ln,cn),e=[mo.x,mo.y,mo.z],ac(e,ls,cs,hs,po))}clampPoint(t,e){return e.copy(t).clamp(this.min,this.max)}distanceToPoint(t){return this.clampPoint(t,Mi).distanceTo(t)}getBoundingSphere(t){return this.isEmpty()?t.makeEmpty():(this.getCenter(t.center),t.radius=this.getSize(Mi).length()*.5),t}intersect(t){return this.min.max(t.min),this.max.min(t.max),this.isEmpty()&&this.makeEmpty(),this}union(t){return this.min.min(t.min),this.max.max(t.max),this}applyMatrix4(t){return this.isEmpty()?this:(Hi[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(t),Hi[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(t),Hi[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(t),Hi[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(t),Hi[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(t),Hi[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(t),Hi[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(t),Hi[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(t),this.setFromPoints(Hi),this)}translate(t){return this.min.add(t),this.max.add(t),this}equals(t){return t.min.equals(this.min)&&t.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(t){return this.min.fromArray(t.min),this.max.fromArray(t.max),this}},Hi=[new N,new N,new N,new N,new N,new N,new N,new N],Mi=new N,fo=new Di,ls=new N,cs=new N,hs=new N,ln=new N,cn=new N,Pn=new N,js=new N,po=new N,mo=new N,In=new N;function ac(n,t,e,i,s){for(let r=0,o=n.length-3;r<=o;r+=3){In.fromArray(n,r);let a=s.x*Math.abs(In.x)+s.y*Math.abs(In.y)+s.z*Math.abs(In.z),l=t.dot(In),c=e.dot(In),h=i.dot(In);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var we=new N,go=new Lt,tg=0,Ne=class extends Si{constructor(t,e,i=!1){if(super(),Array.isArray(t))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:tg++}),this.name="",this.array=t,this.itemSize=e,this.count=t!==void 0?t.length/e:0,this.normalized=i,this.usage=bd,this.updateRanges=[],this.gpuType=xi,this.version=0,this._normalizationScale=t!==void 0?jc(t):void 0}onUploadCallback(){}set needsUpdate(t){t===!0&&this.version++}setUsage(t){return this.usage=t,this}addUpdateRange(t,e){this.updateRanges.push({start:t,count:e})}clearUpdateRanges(){this.updateRanges.length=0}copy(t){return this.name=t.name,this.array=new t.array.constructor(t.array),this.itemSize=t.itemSize,this.count=t.count,this.normalized=t.normalized,this.usage=t.usage,this.gpuType=t.gpuType,this._normalizationScale=t._normalizationScale,this}copyAt(t,e,i){t*=this.itemSize,i*=e.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[t+s]=e.array[i+s];return this}copyArray(t){return this.array.set(t),this}applyMatrix3(t){if(this.itemSize===2)for(let e=0,i=this.count;e<i;e++)go.fromBufferAttribute(this,e),go.applyMatrix3(t),this.setXY(e,go.x,go.y);else if(this.itemSize===3)for(let e=0,i=this.count;e<i;e++)we.fromBufferAttribute(this,e),we.applyMatrix3(t),this.setXYZ(e,we.x,we.y,we.z);return this}applyMatrix4(t){for(let e=0,i=this.count;e<i;e++)we.fromBufferAttribute(this,e),we.applyMatrix4(t),this.setXYZ(e,we.x,we.y,we.z);return this}applyNormalMatrix(t){for(let e=0,i=this.count;e<i;e++)we.fromBufferAttribute(this,e),we.applyNormalMatrix(t),this.setXYZ(e,we.x,we.y,we.z);return this}transformDirection(t){for(let e=0,i=this.count;e<i;e++)we.fromBufferAttribute(this,e),we.transformDirection(t),this.setXYZ(e,we.x,we.y,we.z);return this}set(t,e=0){return this.array.set(t,e),this}getComponent(t,e){let i=this.array[t*this.itemSize+e];return this.normalized&&(i=this._denormalize(i)),i}setComponent(t,e,i){return this.normalized&&(i=this._normalize(i)),this.array[t*this.itemSize+e]=i,this}getX(t){let e=this.array[t*this.itemSize];return this.normalized&&(e=this._denormalize(e)),e}setX(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize]=e,this}getY(t){let e=this.array[t*this.itemSize+1];return this.normalized&&(e=this._denormalize(e)),e}setY(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+1]=e,this}getZ(t){let e=this.array[t*this.itemSize+2];return this.normalized&&(e=this._denormalize(e)),e}setZ(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+2]=e,this}getW(t){let e=this.array[t*this.itemSize+3];return this.normalized&&(e=this._denormalize(e)),e}setW(t,e){return this.normalized&&(e=this._normalize(e)),this.array[t*this.itemSize+3]=e,this}setXY(t,e,i){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i)),this.array[t+0]=e,this.array[t+1]=i,this}setXYZ(t,e,i,s){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this}setXYZW(t,e,i,s,r){return t*=this.itemSize,this.normalized&&(e=this._normalize(e),i=this._normalize(i),s=this._normalize(s),r=this._normalize(r)),this.array[t+0]=e,this.array[t+1]=i,this.array[t+2]=s,this.array[t+3]=r,this}onUpload(t){return this.onUploadCallback=t,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let t={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return t.name=this.name,t.usage=this.usage,t.gpuType=this.gpuType,t}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(t){let e=this._normalizationScale;return e!==void 0?Math.max(t/e,-1):Td(t,this.array)}_normalize(t){let e=this._normalizationScale;return e!==void 0?Math.round(t*e):Ad(t,this.array)}};var pr=class extends Ne{constructor(t,e,i){super(new Uint16Array(t),e,i)}};var mr=class extends Ne{constructor(t,e,i){super(new Uint32Array(t),e,i)}};var Jt=class extends Ne{constructor(t,e,i){super(new Float32Array(t),e,i)}},eg=new Di,Qs=new N,lc=new N,qi=class{constructor(t=new N,e=-1){this.isSphere=!0,this.center=t,this.radius=e}set(t,e){return this.center.copy(t),this.radius=e,this}setFromPoints(t,e){let i=this.center;e!==void 0?i.copy(e):eg.setFromPoints(t).getCenter(i);let s=0;for(let r=0,o=t.length;r<o;r++)s=Math.max(s,i.distanceToSquared(t[r]));return this.radius=Math.sqrt(s),this}copy(t){return this.center.copy(t.center),this.radius=t.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(t){return t.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(t){return t.distanceTo(this.center)-this.radius}intersectsSphere(t){let e=this.radius+t.radius;return t.center.distanceToSquared(this.center)<=e*e}intersectsBox(t){return t.intersectsSphere(this)}intersectsPlane(t){return Math.abs(t.distanceToPoint(this.center))<=this.radius}clampPoint(t,e){let i=this.center.distanceToSquared(t);return e.copy(t),i>this.radius*this.radius&&(e.sub(this.center).normalize(),e.multiplyScalar(this.radius).add(this.center)),e}getBoundingBox(t){return this.isEmpty()?(t.makeEmpty(),t):(t.set(this.center,this.center),t.expandByScalar(this.radius),t)}applyMatrix4(t){return this.center.applyMatrix4(t),this.radius=this.radius*t.getMaxScaleOnAxis(),this}translate(t){return this.center.add(t),this}expandByPoint(t){if(this.isEmpty())return this.center.copy(t),this.radius=0,this;Qs.subVectors(t,this.center);let e=Qs.lengthSq();if(e>this.radius*this.radius){let i=Math.sqrt(e),s=(i-this.radius)*.5;this.center.addScaledVector(Qs,s/i),this.radius+=s}return this}union(t){return t.isEmpty()?this:this.isEmpty()?(this.copy(t),this):(this.center.equals(t.center)===!0?this.radius=Math.max(this.radius,t.radius):(lc.subVectors(t.center,this.center).setLength(t.radius),this.expandByPoint(Qs.copy(t.center).add(lc)),this.expandByPoint(Qs.copy(t.center).sub(lc))),this)}equals(t){return t.center.equals(this.center)&&t.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(t){return this.radius=t.radius,this.center.fromArray(t.center),this}},ig=0,mi=new $t,cc=new Be,us=new N,oi=new Di,tr=new Di,De=new N,ue=class n extends Si{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:ig++}),this.uuid=Is(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(t){return Array.isArray(t)?this.index=new(Am(t)?mr:pr)(t,1):this.index=t,this}setIndirect(t,e=0){return this.indirect=t,this.indirectOffset=e,this}getIndirect(){return this.indirect}getAttribute(t){return this.attributes[t]}setAttribute(t,e){return this.attributes[t]=e,this}deleteAttribute(t){return delete this.attributes[t],this}hasAttribute(t){return this.attributes[t]!==void 0}addGroup(t,e,i=0){this.groups.push({start:t,count:e,materialIndex:i})}clearGroups(){this.groups=[]}setDrawRange(t,e){this.drawRange.start=t,this.drawRange.count=e}applyMatrix4(t){let e=this.attributes.position;e!==void 0&&(e.applyMatrix4(t),e.needsUpdate=!0);let i=this.attributes.normal;if(i!==void 0){let r=new Nt().getNormalMatrix(t);i.applyNormalMatrix(r),i.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(t),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(t){return mi.makeRotationFromQuaternion(t),this.applyMatrix4(mi),this}rotateX(t){return mi.makeRotationX(t),this.applyMatrix4(mi),this}rotateY(t){return mi.makeRotationY(t),this.applyMatrix4(mi),this}rotateZ(t){return mi.makeRotationZ(t),this.applyMatrix4(mi),this}translate(t,e,i){return mi.makeTranslation(t,e,i),this.applyMatrix4(mi),this}scale(t,e,i){return mi.makeScale(t,e,i),this.applyMatrix4(mi),this}lookAt(t){return cc.lookAt(t),cc.updateMatrix(),this.applyMatrix4(cc.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(us).negate(),this.translate(us.x,us.y,us.z),this}setFromPoints(t){let e=this.getAttribute("position");if(e===void 0){let i=[];for(let s=0,r=t.length;s<r;s++){let o=t[s];i.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Jt(i,3))}else{let i=Math.min(t.length,e.count);for(let s=0;s<i;s++){let r=t[s];e.setXYZ(s,r.x,r.y,r.z||0)}t.length>e.count&&At("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),e.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Di);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Dt("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new N(-1/0,-1/0,-1/0),new N(1/0,1/0,1/0));return}if(t!==void 0){if(this.boundingBox.setFromBufferAttribute(t),e)for(let i=0,s=e.length;i<s;i++){let r=e[i];oi.setFromBufferAttribute(r),this.morphTargetsRelative?(De.addVectors(this.boundingBox.min,oi.min),this.boundingBox.expandByPoint(De),De.addVectors(this.boundingBox.max,oi.max),this.boundingBox.expandByPoint(De)):(this.boundingBox.expandByPoint(oi.min),this.boundingBox.expandByPoint(oi.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&Dt('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new qi);let t=this.attributes.position,e=this.morphAttributes.position;if(t&&t.isGLBufferAttribute){Dt("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new N,1/0);return}if(t){let i=this.boundingSphere.center;if(oi.setFromBufferAttribute(t),e)for(let r=0,o=e.length;r<o;r++){let a=e[r];tr.setFromBufferAttribute(a),this.morphTargetsRelative?(De.addVectors(oi.min,tr.min),oi.expandByPoint(De),De.addVectors(oi.max,tr.max),oi.expandByPoint(De)):(oi.expandByPoint(tr.min),oi.expandByPoint(tr.max))}oi.getCenter(i);let s=0;for(let r=0,o=t.count;r<o;r++)De.fromBufferAttribute(t,r),s=Math.max(s,i.distanceToSquared(De));if(e)for(let r=0,o=e.length;r<o;r++){let a=e[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)De.fromBufferAttribute(a,c),l&&(us.fromBufferAttribute(t,c),De.add(us)),s=Math.max(s,i.distanceToSquared(De))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&Dt('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let t=this.index,e=this.attributes;if(t===null||e.position===void 0||e.normal===void 0||e.uv===void 0){Dt("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let i=e.position,s=e.normal,r=e.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==i.count)&&(o=new Ne(new Float32Array(4*i.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(i.count);for(let D=0;D<i.count;D++)a[D]=new N,l[D]=new N;let h=new N,u=new N,d=new N,f=new Lt,p=new Lt,_=new Lt,g=new N,m=new N;function b(D,P,U){c[D]=c[P]=c[U]=1,h.fromBufferAttribute(i,D),u.fromBufferAttribute(i,P),d.fromBufferAttribute(i,U),f.fromBufferAttribute(r,D),p.fromBufferAttribute(r,P),_.fromBufferAttribute(r,U),u.sub(h),d.sub(h),p.sub(f),_.sub(f);let F=1/(p.x*_.y-_.x*p.y);isFinite(F)&&(g.copy(u).multiplyScalar(_.y).addScaledVector(d,-p.y).multiplyScalar(F),m.copy(d).multiplyScalar(p.x).addScaledVector(u,-_.x).multiplyScalar(F),a[D].add(g),a[P].add(g),a[U].add(g),l[D].add(m),l[P].add(m),l[U].add(m))}let S=this.groups;S.length===0&&(S=[{start:0,count:t.count}]);for(let D=0,P=S.length;D<P;++D){let U=S[D],F=U.start,W=U.count;for(let I=F,H=F+W;I<H;I+=3)b(t.getX(I+0),t.getX(I+1),t.getX(I+2))}let w=new N,E=new N,T=new N,x=new N;function M(D){T.fromBufferAttribute(s,D),x.copy(T);let P=a[D];w.copy(P),w.sub(T.multiplyScalar(T.dot(P))).normalize(),E.crossVectors(x,P);let F=E.dot(l[D])<0?-1:1;o.setXYZW(D,w.x,w.y,w.z,F)}for(let D=0,P=i.count;D<P;++D)c[D]&&M(D);this._transformed=!0}computeVertexNormals(){let t=this.index,e=this.getAttribute("position");if(e!==void 0){let i=this.getAttribute("normal");if(i===void 0||i.count!==e.count)i=new Ne(new Float32Array(e.count*3),3),this.setAttribute("normal",i);else for(let d=0,f=i.count;d<f;d++)i.setXYZ(d,0,0,0);let s=new N,r=new N,o=new N,a=new N,l=new N,c=new N,h=new N,u=new N;if(t)for(let d=0,f=t.count;d<f;d+=3){let p=t.getX(d+0),_=t.getX(d+1),g=t.getX(d+2);s.fromBufferAttribute(e,p),r.fromBufferAttribute(e,_),o.fromBufferAttribute(e,g),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),a.fromBufferAttribute(i,p),l.fromBufferAttribute(i,_),c.fromBufferAttribute(i,g),a.add(h),l.add(h),c.add(h),i.setXYZ(p,a.x,a.y,a.z),i.setXYZ(_,l.x,l.y,l.z),i.setXYZ(g,c.x,c.y,c.z)}else for(let d=0,f=e.count;d<f;d+=3)s.fromBufferAttribute(e,d+0),r.fromBufferAttribute(e,d+1),o.fromBufferAttribute(e,d+2),h.subVectors(o,r),u.subVectors(s,r),h.cross(u),i.setXYZ(d+0,h.x,h.y,h.z),i.setXYZ(d+1,h.x,h.y,h.z),i.setXYZ(d+2,h.x,h.y,h.z);this.normalizeNormals(),i.needsUpdate=!0}}normalizeNormals(){let t=this.attributes.normal;for(let e=0,i=t.count;e<i;e++)De.fromBufferAttribute(t,e),De.normalize(),t.setXYZ(e,De.x,De.y,De.z)}toNonIndexed(){function t(a,l){let c=a.array,h=a.itemSize,u=a.normalized,d=new c.constructor(l.length*h),f=0,p=0;for(let _=0,g=l.length;_<g;_++){a.isInterleavedBufferAttribute?f=l[_]*a.data.stride+a.offset:f=l[_]*h;for(let m=0;m<h;m++)d[p++]=c[f++]}return new Ne(d,h,u)}if(this.index===null)return At("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let e=new n,i=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=t(l,i);e.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,u=c.length;h<u;h++){let d=c[h],f=t(d,i);l.push(f)}e.morphAttributes[a]=l}e.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];e.addGroup(c.start,c.count,c.materialIndex)}return e}toJSON(){let t={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(t.uuid=this.uuid,t.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,t.name=this.name,Object.keys(this.userData).length>0&&(t.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(t[c]=l[c]);return t}t.data={attributes:{}};let e=this.index;e!==null&&(t.data.index={type:e.array.constructor.name,array:Array.prototype.slice.call(e.array)});let i=this.attributes;for(let l in i){let c=i[l];t.data.attributes[l]=c.toJSON(t.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let u=0,d=c.length;u<d;u++){let f=c[u];h.push(f.toJSON(t.data))}h.length>0&&(s[l]=h,r=!0)}r&&(t.data.morphAttributes=s,t.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(t.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(t.data.boundingSphere=a.toJSON()),t}clone(){return new this.constructor().copy(this)}copy(t){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let e={};this.name=t.name;let i=t.index;i!==null&&this.setIndex(i.clone());let s=t.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(e))}let r=t.morphAttributes;for(let c in r){let h=[],u=r[c];for(let d=0,f=u.length;d<f;d++)h.push(u[d].clone(e));this.morphAttributes[c]=h}this.morphTargetsRelative=t.morphTargetsRelative;let o=t.groups;for(let c=0,h=o.length;c<h;c++){let u=o[c];this.addGroup(u.start,u.count,u.materialIndex)}let a=t.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=t.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=t.drawRange.start,this.drawRange.count=t.drawRange.count,this.userData=t.userData,this._transformed=t._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}};var hc=new N,ng=new N,sg=new Nt,ai=class{constructor(t=new N(1,0,0),e=0){this.isPlane=!0,this.normal=t,this.constant=e}set(t,e){return this.normal.copy(t),this.constant=e,this}setComponents(t,e,i,s){return this.normal.set(t,e,i),this.constant=s,this}setFromNormalAndCoplanarPoint(t,e){return this.normal.copy(t),this.constant=-e.dot(this.normal),this}setFromCoplanarPoints(t,e,i){let s=hc.subVectors(i,e).cross(ng.subVectors(t,e)).normalize();return this.setFromNormalAndCoplanarPoint(s,t),this}copy(t){return this.normal.copy(t.normal),this.constant=t.constant,this}normalize(){let t=1/this.normal.length();return this.normal.multiplyScalar(t),this.constant*=t,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(t){return this.normal.dot(t)+this.constant}distanceToSphere(t){return this.distanceToPoint(t.center)-t.radius}projectPoint(t,e){return e.copy(t).addScaledVector(this.normal,-this.distanceToPoint(t))}intersectLine(t,e,i=!0){let s=t.delta(hc),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(t.start)===0?e.copy(t.start):null;let o=-(t.start.dot(this.normal)+this.constant)/r;return i===!0&&(o<0||o>1)?null:e.copy(t.start).addScaledVector(s,o)}intersectsLine(t){let e=this.distanceToPoint(t.start),i=this.distanceToPoint(t.end);return e<0&&i>0||i<0&&e>0}intersectsBox(t){return t.intersectsPlane(this)}intersectsSphere(t){return t.intersectsPlane(this)}coplanarPoint(t){return t.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(t,e){let i=e||sg.getNormalMatrix(t),s=this.coplanarPoint(hc).applyMatrix4(t),r=this.normal.applyMatrix3(i).normalize();return this.constant=-s.dot(r),this}translate(t){return this.constant-=t.dot(this.normal),this}equals(t){return t.normal.equals(this.normal)&&t.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(t){return this.normal.fromArray(t.normal),this.constant=t.constant,this}},rg=0,$i=class extends Si{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:rg++}),this.uuid=Is(),this.name="",this.type="Material",this.blending=Rs,this.side=vn,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=Cc,this.blendDst=Pc,this.blendEquation=Hn,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new Pt(0,0,0),this.blendAlpha=0,this.depthFunc=xs,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=md,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=No,this.stencilZFail=No,this.stencilZPass=No,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(t){this._alphaTest>0!=t>0&&this.version++,this._alphaTest=t}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(t){if(t!==void 0)for(let e in t){let i=t[e];if(i===void 0){At(`Material: parameter '${e}' has value of undefined.`);continue}let s=this[e];if(s===void 0){At(`Material: '${e}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(i):s&&s.isVector2&&i&&i.isVector2||s&&s.isEuler&&i&&i.isEuler||s&&s.isVector3&&i&&i.isVector3?s.copy(i):this[e]=i}}toJSON(t){let e=t===void 0||typeof t=="string";e&&(t={textures:{},images:{}});let i={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};i.uuid=this.uuid,i.type=this.type,i.blending=this.blending,i.side=this.side,i.shadowSide=this.shadowSide,i.vertexColors=this.vertexColors,i.opacity=this.opacity,i.transparent=this.transparent,i.blendSrc=this.blendSrc,i.blendDst=this.blendDst,i.blendEquation=this.blendEquation,i.blendSrcAlpha=this.blendSrcAlpha,i.blendDstAlpha=this.blendDstAlpha,i.blendEquationAlpha=this.blendEquationAlpha,i.blendColor=this.blendColor.getHex(),i.blendAlpha=this.blendAlpha,i.depthFunc=this.depthFunc,i.depthTest=this.depthTest,i.depthWrite=this.depthWrite,i.colorWrite=this.colorWrite,i.clipIntersection=this.clipIntersection,i.clipShadows=this.clipShadows,i.stencilWriteMask=this.stencilWriteMask,i.stencilFunc=this.stencilFunc,i.stencilRef=this.stencilRef,i.stencilFuncMask=this.stencilFuncMask,i.stencilFail=this.stencilFail,i.stencilZFail=this.stencilZFail,i.stencilZPass=this.stencilZPass,i.stencilWrite=this.stencilWrite,i.polygonOffset=this.polygonOffset,i.polygonOffsetFactor=this.polygonOffsetFactor,i.polygonOffsetUnits=this.polygonOffsetUnits,i.dithering=this.dithering,i.alphaTest=this.alphaTest,i.alphaHash=this.alphaHash,i.alphaToCoverage=this.alphaToCoverage,i.premultipliedAlpha=this.premultipliedAlpha,i.forceSinglePass=this.forceSinglePass,i.allowOverride=this.allowOverride,i.visible=this.visible,i.toneMapped=this.toneMapped,i.name=this.name,this.color&&this.color.isColor&&(i.color=this.color.getHex()),this.roughness!==void 0&&(i.roughness=this.roughness),this.metalness!==void 0&&(i.metalness=this.metalness),this.sheen!==void 0&&(i.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(i.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(i.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(i.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(i.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(i.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(i.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(i.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(i.shininess=this.shininess),this.clearcoat!==void 0&&(i.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(i.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(i.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(i.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(t).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(i.clearcoatMap=this.clearcoatMap.toJSON(t).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(i.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(t).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(i.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(t).uuid,i.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(i.sheenColorMap=this.sheenColorMap.toJSON(t).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(i.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(t).uuid),this.dispersion!==void 0&&(i.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(i.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(i.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(i.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(i.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(i.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(i.iridescenceMap=this.iridescenceMap.toJSON(t).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(i.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(t).uuid),this.anisotropy!==void 0&&(i.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(i.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(i.anisotropyMap=this.anisotropyMap.toJSON(t).uuid),this.map&&this.map.isTexture&&(i.map=this.map.toJSON(t).uuid),this.matcap&&this.matcap.isTexture&&(i.matcap=this.matcap.toJSON(t).uuid),this.alphaMap&&this.alphaMap.isTexture&&(i.alphaMap=this.alphaMap.toJSON(t).uuid),this.lightMap&&this.lightMap.isTexture&&(i.lightMap=this.lightMap.toJSON(t).uuid,i.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(i.aoMap=this.aoMap.toJSON(t).uuid,i.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(i.bumpMap=this.bumpMap.toJSON(t).uuid,i.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(i.normalMap=this.normalMap.toJSON(t).uuid,i.normalMapType=this.normalMapType,i.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(i.displacementMap=this.displacementMap.toJSON(t).uuid,i.displacementScale=this.displacementScale,i.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(i.roughnessMap=this.roughnessMap.toJSON(t).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(i.metalnessMap=this.metalnessMap.toJSON(t).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(i.emissiveMap=this.emissiveMap.toJSON(t).uuid),this.specularMap&&this.specularMap.isTexture&&(i.specularMap=this.specularMap.toJSON(t).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(i.specularIntensityMap=this.specularIntensityMap.toJSON(t).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(i.specularColorMap=this.specularColorMap.toJSON(t).uuid),this.envMap&&this.envMap.isTexture&&(i.envMap=this.envMap.toJSON(t).uuid,this.combine!==void 0&&(i.combine=this.combine)),this.envMapRotation!==void 0&&(i.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(i.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(i.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(i.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(i.gradientMap=this.gradientMap.toJSON(t).uuid),this.transmission!==void 0&&(i.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(i.transmissionMap=this.transmissionMap.toJSON(t).uuid),this.thickness!==void 0&&(i.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(i.thicknessMap=this.thicknessMap.toJSON(t).uuid),this.attenuationDistance!==void 0&&(i.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(i.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(i.size=this.size),this.sizeAttenuation!==void 0&&(i.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(i.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(i.rotation=this.rotation),this.depthPacking!==void 0&&(i.depthPacking=this.depthPacking),this.linewidth!==void 0&&(i.linewidth=this.linewidth),this.linecap!==void 0&&(i.linecap=this.linecap),this.linejoin!==void 0&&(i.linejoin=this.linejoin),this.dashSize!==void 0&&(i.dashSize=this.dashSize),this.gapSize!==void 0&&(i.gapSize=this.gapSize),this.scale!==void 0&&(i.scale=this.scale),this.wireframe!==void 0&&(i.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(i.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(i.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(i.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(i.flatShading=this.flatShading),this.fog!==void 0&&(i.fog=this.fog),Object.keys(this.userData).length>0&&(i.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(e){let r=s(t.textures),o=s(t.images);r.length>0&&(i.textures=r),o.length>0&&(i.images=o)}return i}fromJSON(t,e){if(t.uuid!==void 0&&(this.uuid=t.uuid),t.name!==void 0&&(this.name=t.name),t.color!==void 0&&this.color!==void 0&&this.color.setHex(t.color),t.roughness!==void 0&&(this.roughness=t.roughness),t.metalness!==void 0&&(this.metalness=t.metalness),t.sheen!==void 0&&(this.sheen=t.sheen),t.sheenColor!==void 0&&(this.sheenColor=new Pt().setHex(t.sheenColor)),t.sheenRoughness!==void 0&&(this.sheenRoughness=t.sheenRoughness),t.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(t.emissive),t.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(t.specular),t.specularIntensity!==void 0&&(this.specularIntensity=t.specularIntensity),t.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(t.specularColor),t.shininess!==void 0&&(this.shininess=t.shininess),t.clearcoat!==void 0&&(this.clearcoat=t.clearcoat),t.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=t.clearcoatRoughness),t.diffuseRoughness!==void 0&&(this.diffuseRoughness=t.diffuseRoughness),t.dispersion!==void 0&&(this.dispersion=t.dispersion),t.retroreflectivity!==void 0&&(this.retroreflectivity=t.retroreflectivity),t.iridescence!==void 0&&(this.iridescence=t.iridescence),t.iridescenceIOR!==void 0&&(this.iridescenceIOR=t.iridescenceIOR),t.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessMinimum),t.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=t.iridescenceThicknessMaximum),t.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=t.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=t.iridescenceThicknessRange[1]),t.transmission!==void 0&&(this.transmission=t.transmission),t.thickness!==void 0&&(this.thickness=t.thickness),t.attenuationDistance!==void 0&&(this.attenuationDistance=t.attenuationDistance),t.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(t.attenuationColor),t.anisotropy!==void 0&&(this.anisotropy=t.anisotropy),t.anisotropyRotation!==void 0&&(this.anisotropyRotation=t.anisotropyRotation),t.fog!==void 0&&(this.fog=t.fog),t.flatShading!==void 0&&(this.flatShading=t.flatShading),t.blending!==void 0&&(this.blending=t.blending),t.combine!==void 0&&(this.combine=t.combine),t.side!==void 0&&(this.side=t.side),t.shadowSide!==void 0&&(this.shadowSide=t.shadowSide),t.opacity!==void 0&&(this.opacity=t.opacity),t.transparent!==void 0&&(this.transparent=t.transparent),t.alphaTest!==void 0&&(this.alphaTest=t.alphaTest),t.alphaHash!==void 0&&(this.alphaHash=t.alphaHash),t.depthFunc!==void 0&&(this.depthFunc=t.depthFunc),t.depthTest!==void 0&&(this.depthTest=t.depthTest),t.depthWrite!==void 0&&(this.depthWrite=t.depthWrite),t.colorWrite!==void 0&&(this.colorWrite=t.colorWrite),t.clippingPlanes!==void 0&&(this.clippingPlanes=t.clippingPlanes.map(i=>new ai().fromJSON(i))),t.clipIntersection!==void 0&&(this.clipIntersection=t.clipIntersection),t.clipShadows!==void 0&&(this.clipShadows=t.clipShadows),t.depthPacking!==void 0&&(this.depthPacking=t.depthPacking),t.blendSrc!==void 0&&(this.blendSrc=t.blendSrc),t.blendDst!==void 0&&(this.blendDst=t.blendDst),t.blendEquation!==void 0&&(this.blendEquation=t.blendEquation),t.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=t.blendSrcAlpha),t.blendDstAlpha!==void 0&&(this.blendDstAlpha=t.blendDstAlpha),t.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=t.blendEquationAlpha),t.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(t.blendColor),t.blendAlpha!==void 0&&(this.blendAlpha=t.blendAlpha),t.stencilWriteMask!==void 0&&(this.stencilWriteMask=t.stencilWriteMask),t.stencilFunc!==void 0&&(this.stencilFunc=t.stencilFunc),t.stencilRef!==void 0&&(this.stencilRef=t.stencilRef),t.stencilFuncMask!==void 0&&(this.stencilFuncMask=t.stencilFuncMask),t.stencilFail!==void 0&&(this.stencilFail=t.stencilFail),t.stencilZFail!==void 0&&(this.stencilZFail=t.stencilZFail),t.stencilZPass!==void 0&&(this.stencilZPass=t.stencilZPass),t.stencilWrite!==void 0&&(this.stencilWrite=t.stencilWrite),t.wireframe!==void 0&&(this.wireframe=t.wireframe),t.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=t.wireframeLinewidth),t.wireframeLinecap!==void 0&&(this.wireframeLinecap=t.wireframeLinecap),t.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=t.wireframeLinejoin),t.rotation!==void 0&&(this.rotation=t.rotation),t.linewidth!==void 0&&(this.linewidth=t.linewidth),t.linecap!==void 0&&(this.linecap=t.linecap),t.linejoin!==void 0&&(this.linejoin=t.linejoin),t.dashSize!==void 0&&(this.dashSize=t.dashSize),t.gapSize!==void 0&&(this.gapSize=t.gapSize),t.scale!==void 0&&(this.scale=t.scale),t.polygonOffset!==void 0&&(this.polygonOffset=t.polygonOffset),t.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=t.polygonOffsetFactor),t.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=t.polygonOffsetUnits),t.dithering!==void 0&&(this.dithering=t.dithering),t.alphaToCoverage!==void 0&&(this.alphaToCoverage=t.alphaToCoverage),t.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=t.premultipliedAlpha),t.forceSinglePass!==void 0&&(this.forceSinglePass=t.forceSinglePass),t.allowOverride!==void 0&&(this.allowOverride=t.allowOverride),t.visible!==void 0&&(this.visible=t.visible),t.toneMapped!==void 0&&(this.toneMapped=t.toneMapped),t.userData!==void 0&&(this.userData=t.userData),t.vertexColors!==void 0&&(typeof t.vertexColors=="number"?this.vertexColors=t.vertexColors>0:this.vertexColors=t.vertexColors),t.size!==void 0&&(this.size=t.size),t.sizeAttenuation!==void 0&&(this.sizeAttenuation=t.sizeAttenuation),t.map!==void 0&&(this.map=e[t.map]||null),t.matcap!==void 0&&(this.matcap=e[t.matcap]||null),t.alphaMap!==void 0&&(this.alphaMap=e[t.alphaMap]||null),t.bumpMap!==void 0&&(this.bumpMap=e[t.bumpMap]||null),t.bumpScale!==void 0&&(this.bumpScale=t.bumpScale),t.normalMap!==void 0&&(this.normalMap=e[t.normalMap]||null),t.normalMapType!==void 0&&(this.normalMapType=t.normalMapType),t.normalScale!==void 0){let i=t.normalScale;Array.isArray(i)===!1&&(i=[i,i]),this.normalScale=new Lt().fromArray(i)}return t.displacementMap!==void 0&&(this.displacementMap=e[t.displacementMap]||null),t.displacementScale!==void 0&&(this.displacementScale=t.displacementScale),t.displacementBias!==void 0&&(this.displacementBias=t.displacementBias),t.roughnessMap!==void 0&&(this.roughnessMap=e[t.roughnessMap]||null),t.metalnessMap!==void 0&&(this.metalnessMap=e[t.metalnessMap]||null),t.emissiveMap!==void 0&&(this.emissiveMap=e[t.emissiveMap]||null),t.emissiveIntensity!==void 0&&(this.emissiveIntensity=t.emissiveIntensity),t.specularMap!==void 0&&(this.specularMap=e[t.specularMap]||null),t.specularIntensityMap!==void 0&&(this.specularIntensityMap=e[t.specularIntensityMap]||null),t.specularColorMap!==void 0&&(this.specularColorMap=e[t.specularColorMap]||null),t.envMap!==void 0&&(this.envMap=e[t.envMap]||null),t.envMapRotation!==void 0&&this.envMapRotation.fromArray(t.envMapRotation),t.envMapIntensity!==void 0&&(this.envMapIntensity=t.envMapIntensity),t.reflectivity!==void 0&&(this.reflectivity=t.reflectivity),t.refractionRatio!==void 0&&(this.refractionRatio=t.refractionRatio),t.lightMap!==void 0&&(this.lightMap=e[t.lightMap]||null),t.lightMapIntensity!==void 0&&(this.lightMapIntensity=t.lightMapIntensity),t.aoMap!==void 0&&(this.aoMap=e[t.aoMap]||null),t.aoMapIntensity!==void 0&&(this.aoMapIntensity=t.aoMapIntensity),t.gradientMap!==void 0&&(this.gradientMap=e[t.gradientMap]||null),t.clearcoatMap!==void 0&&(this.clearcoatMap=e[t.clearcoatMap]||null),t.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=e[t.clearcoatRoughnessMap]||null),t.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=e[t.clearcoatNormalMap]||null),t.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new Lt().fromArray(t.clearcoatNormalScale)),t.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=e[t.diffuseRoughnessMap]||null),t.iridescenceMap!==void 0&&(this.iridescenceMap=e[t.iridescenceMap]||null),t.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=e[t.iridescenceThicknessMap]||null),t.transmissionMap!==void 0&&(this.transmissionMap=e[t.transmissionMap]||null),t.thicknessMap!==void 0&&(this.thicknessMap=e[t.thicknessMap]||null),t.anisotropyMap!==void 0&&(this.anisotropyMap=e[t.anisotropyMap]||null),t.sheenColorMap!==void 0&&(this.sheenColorMap=e[t.sheenColorMap]||null),t.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=e[t.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(t){this.name=t.name,this.blending=t.blending,this.side=t.side,this.vertexColors=t.vertexColors,this.opacity=t.opacity,this.transparent=t.transparent,this.blendSrc=t.blendSrc,this.blendDst=t.blendDst,this.blendEquation=t.blendEquation,this.blendSrcAlpha=t.blendSrcAlpha,this.blendDstAlpha=t.blendDstAlpha,this.blendEquationAlpha=t.blendEquationAlpha,this.blendColor.copy(t.blendColor),this.blendAlpha=t.blendAlpha,this.depthFunc=t.depthFunc,this.depthTest=t.depthTest,this.depthWrite=t.depthWrite,this.stencilWriteMask=t.stencilWriteMask,this.stencilFunc=t.stencilFunc,this.stencilRef=t.stencilRef,this.stencilFuncMask=t.stencilFuncMask,this.stencilFail=t.stencilFail,this.stencilZFail=t.stencilZFail,this.stencilZPass=t.stencilZPass,this.stencilWrite=t.stencilWrite;let e=t.clippingPlanes,i=null;if(e!==null){let s=e.length;i=new Array(s);for(let r=0;r!==s;++r)i[r]=e[r].clone()}return this.clippingPlanes=i,this.clipIntersection=t.clipIntersection,this.clipShadows=t.clipShadows,this.shadowSide=t.shadowSide,this.colorWrite=t.colorWrite,this.precision=t.precision,this.polygonOffset=t.polygonOffset,this.polygonOffsetFactor=t.polygonOffsetFactor,this.polygonOffsetUnits=t.polygonOffsetUnits,this.dithering=t.dithering,this.alphaTest=t.alphaTest,this.alphaHash=t.alphaHash,this.alphaToCoverage=t.alphaToCoverage,this.premultipliedAlpha=t.premultipliedAlpha,this.forceSinglePass=t.forceSinglePass,this.allowOverride=t.allowOverride,this.visible=t.visible,this.toneMapped=t.toneMapped,this.userData=JSON.parse(JSON.stringify(t.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(t){t===!0&&this.version++}};var Gi=new N,uc=new N,xo=new N,_o=new N,Nn=class{constructor(t=new N,e=new N(0,0,-1)){this.origin=t,this.direction=e}set(t,e){return this.origin.copy(t),this.direction.copy(e),this}copy(t){return this.origin.copy(t.origin),this.direction.copy(t.direction),this}at(t,e){return e.copy(this.origin).addScaledVector(this.direction,t)}lookAt(t){return this.direction.copy(t).sub(this.origin).normalize(),this}recast(t){return this.origin.copy(this.at(t,Gi)),this}closestPointToPoint(t,e){e.subVectors(t,this.origin);let i=e.dot(this.direction);return i<0?e.copy(this.origin):e.copy(this.origin).addScaledVector(this.direction,i)}distanceToPoint(t){return Math.sqrt(this.distanceSqToPoint(t))}distanceSqToPoint(t){let e=Gi.subVectors(t,this.origin).dot(this.direction);return e<0?this.origin.distanceToSquared(t):(Gi.copy(this.origin).addScaledVector(this.direction,e),Gi.distanceToSquared(t))}distanceSqToSegment(t,e,i,s){uc.copy(t).add(e).multiplyScalar(.5),xo.copy(e).sub(t).normalize(),_o.copy(this.origin).sub(uc);let r=t.distanceTo(e)*.5,o=-this.direction.dot(xo),a=_o.dot(this.direction),l=-_o.dot(xo),c=_o.lengthSq(),h=Math.abs(1-o*o),u,d,f,p;if(h>0)if(u=o*l-a,d=o*a-l,p=r*h,u>=0)if(d>=-p)if(d<=p){let _=1/h;u*=_,d*=_,f=u*(u+o*d+2*a)+d*(o*u+d+2*l)+c}else d=r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d=-r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;else d<=-p?(u=Math.max(0,-(-o*r+a)),d=u>0?-r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c):d<=p?(u=0,d=Math.min(Math.max(-r,-l),r),f=d*(d+2*l)+c):(u=Math.max(0,-(o*r+a)),d=u>0?r:Math.min(Math.max(-r,-l),r),f=-u*u+d*(d+2*l)+c);else d=o>0?-r:r,u=Math.max(0,-(o*d+a)),f=-u*u+d*(d+2*l)+c;return i&&i.copy(this.origin).addScaledVector(this.direction,u),s&&s.copy(uc).addScaledVector(xo,d),f}intersectSphere(t,e){if(t.radius<0)return null;Gi.subVectors(t.center,this.origin);let i=Gi.dot(this.direction),s=Gi.dot(Gi)-i*i,r=t.radius*t.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=i-o,l=i+o;return l<0?null:a<0?this.at(l,e):this.at(a,e)}intersectsSphere(t){return t.radius<0?!1:this.distanceSqToPoint(t.center)<=t.radius*t.radius}distanceToPlane(t){let e=t.normal.dot(this.direction);if(e===0)return t.distanceToPoint(this.origin)===0?0:null;let i=-(this.origin.dot(t.normal)+t.constant)/e;return i>=0?i:null}intersectPlane(t,e){let i=this.distanceToPlane(t);return i===null?null:this.at(i,e)}intersectsPlane(t){let e=t.distanceToPoint(this.origin);return e===0||t.normal.dot(this.direction)*e<0}intersectBox(t,e){let i,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,u=1/this.direction.z,d=this.origin;return c>=0?(i=(t.min.x-d.x)*c,s=(t.max.x-d.x)*c):(i=(t.max.x-d.x)*c,s=(t.min.x-d.x)*c),h>=0?(r=(t.min.y-d.y)*h,o=(t.max.y-d.y)*h):(r=(t.max.y-d.y)*h,o=(t.min.y-d.y)*h),i>o||r>s||((r>i||isNaN(i))&&(i=r),(o<s||isNaN(s))&&(s=o),u>=0?(a=(t.min.z-d.z)*u,l=(t.max.z-d.z)*u):(a=(t.max.z-d.z)*u,l=(t.min.z-d.z)*u),i>l||a>s)||((a>i||i!==i)&&(i=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(i>=0?i:s,e)}intersectsBox(t){return this.intersectBox(t,Gi)!==null}intersectTriangle(t,e,i,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,u=t.x-o.x,d=t.y-o.y,f=t.z-o.z,p=e.x-o.x,_=e.y-o.y,g=e.z-o.z,m=i.x-o.x,b=i.y-o.y,S=i.z-o.z,w=Math.abs(l),E=Math.abs(c),T=Math.abs(h),x,M,D,P,U,F,W,I,H,$,G,et;if(w>=E&&w>=T?(D=l,F=u,H=p,et=m,l>=0?(x=c,M=h,P=d,U=f,W=_,I=g,$=b,G=S):(x=h,M=c,P=f,U=d,W=g,I=_,$=S,G=b)):E>=T?(D=c,F=d,H=_,et=b,c>=0?(x=h,M=l,P=f,U=u,W=g,I=p,$=S,G=m):(x=l,M=h,P=u,U=f,W=p,I=g,$=m,G=S)):(D=h,F=f,H=g,et=S,h>=0?(x=l,M=c,P=u,U=d,W=p,I=_,$=m,G=b):(x=c,M=l,P=d,U=u,W=_,I=p,$=b,G=m)),D===0)return null;let X=x/D,Q=M/D,tt=1/D,wt=P-X*F,Ot=U-Q*F,J=W-X*H,mt=I-Q*H,yt=$-X*et,Rt=G-Q*et,gt=yt*mt-Rt*J,Bt=wt*Rt-Ot*yt,ve=J*Ot-mt*wt;if(s){if(gt<0||Bt<0||ve<0)return null}else if((gt<0||Bt<0||ve<0)&&(gt>0||Bt>0||ve>0))return null;let It=gt+Bt+ve;if(It===0)return null;let Qt=tt*(gt*F+Bt*H+ve*et);return(It>0?Qt<0:Qt>0)?null:this.at(Qt/It,r)}applyMatrix4(t){return this.origin.applyMatrix4(t),this.direction.transformDirection(t),this}equals(t){return t.origin.equals(this.origin)&&t.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Un=class extends $i{constructor(t){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new Pt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Xi,this.combine=pa,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.fog=t.fog,this}},Su=new $t,Ln=new Nn,yo=new qi,Eu=new N,vo=new N,bo=new N,wo=new N,dc=new N,Mo=new N,Tu=new N,So=new N,de=class extends Be{constructor(t=new ue,e=new Un){super(),this.isMesh=!0,this.type="Mesh",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(t,e){let i=this.geometry,s=i.attributes.position,r=i.morphAttributes.position,o=i.morphTargetsRelative;e.fromBufferAttribute(s,t);let a=this.morphTargetInfluences;if(r&&a){Mo.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],u=r[l];h!==0&&(dc.fromBufferAttribute(u,t),o?Mo.addScaledVector(dc,h):Mo.addScaledVector(dc.sub(e),h))}e.add(Mo)}return e}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(i.boundingSphere===null&&i.computeBoundingSphere(),yo.copy(i.boundingSphere),yo.applyMatrix4(r),Ln.copy(t.ray).recast(t.near),!(yo.containsPoint(Ln.origin)===!1&&(Ln.intersectSphere(yo,Eu)===null||Ln.origin.distanceToSquared(Eu)>(t.far-t.near)**2))&&(Su.copy(r).invert(),Ln.copy(t.ray).applyMatrix4(Su),!(i.boundingBox!==null&&Ln.intersectsBox(i.boundingBox)===!1)&&this._computeIntersections(t,e,Ln)))}_computeIntersections(t,e,i){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,u=r.attributes.normal,d=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,_=d.length;p<_;p++){let g=d[p],m=o[g.materialIndex],b=Math.max(g.start,f.start),S=Math.min(a.count,Math.min(g.start+g.count,f.start+f.count));for(let w=b,E=S;w<E;w+=3){let T=a.getX(w),x=a.getX(w+1),M=a.getX(w+2);s=Eo(this,m,t,i,c,h,u,T,x,M),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=g.materialIndex,e.push(s))}}else{let p=Math.max(0,f.start),_=Math.min(a.count,f.start+f.count);for(let g=p,m=_;g<m;g+=3){let b=a.getX(g),S=a.getX(g+1),w=a.getX(g+2);s=Eo(this,o,t,i,c,h,u,b,S,w),s&&(s.faceIndex=Math.floor(g/3),e.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let p=0,_=d.length;p<_;p++){let g=d[p],m=o[g.materialIndex],b=Math.max(g.start,f.start),S=Math.min(l.count,Math.min(g.start+g.count,f.start+f.count));for(let w=b,E=S;w<E;w+=3){let T=w,x=w+1,M=w+2;s=Eo(this,m,t,i,c,h,u,T,x,M),s&&(s.faceIndex=Math.floor(w/3),s.face.materialIndex=g.materialIndex,e.push(s))}}else{let p=Math.max(0,f.start),_=Math.min(l.count,f.start+f.count);for(let g=p,m=_;g<m;g+=3){let b=g,S=g+1,w=g+2;s=Eo(this,o,t,i,c,h,u,b,S,w),s&&(s.faceIndex=Math.floor(g/3),e.push(s))}}}};function og(n,t,e,i,s,r,o,a){let l;if(t.side===je?l=i.intersectTriangle(o,r,s,!0,a):l=i.intersectTriangle(s,r,o,t.side===vn,a),l===null)return null;So.copy(a),So.applyMatrix4(n.matrixWorld);let c=e.ray.origin.distanceTo(So);return c<e.near||c>e.far?null:{distance:c,point:So.clone(),object:n}}function Eo(n,t,e,i,s,r,o,a,l,c){n.getVertexPosition(a,vo),n.getVertexPosition(l,bo),n.getVertexPosition(c,wo);let h=og(n,t,e,i,vo,bo,wo,Tu);if(h){let u=new N;un.getBarycoord(Tu,vo,bo,wo,u),s&&(h.uv=un.getInterpolatedAttribute(s,a,l,c,u,new Lt)),r&&(h.uv1=un.getInterpolatedAttribute(r,a,l,c,u,new Lt)),o&&(h.normal=un.getInterpolatedAttribute(o,a,l,c,u,new N),h.normal.dot(i.direction)>0&&h.normal.multiplyScalar(-1));let d={a,b:l,c,normal:new N,materialIndex:0};un.getNormal(vo,bo,wo,d.normal),h.face=d,h.barycoord=u}return h}var gr=class extends ti{constructor(t=null,e=1,i=1,s,r,o,a,l,c=Ue,h=Ue,u,d){super(null,o,a,l,c,h,s,r,u,d),this.isDataTexture=!0,this.image={data:t,width:e,height:i},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var xr=class extends Ne{constructor(t,e,i,s=1){super(t,e,i),this.isInstancedBufferAttribute=!0,this.meshPerAttribute=s}copy(t){return super.copy(t),this.meshPerAttribute=t.meshPerAttribute,this}toJSON(){let t=super.toJSON();return t.meshPerAttribute=this.meshPerAttribute,t.isInstancedBufferAttribute=!0,t}},ds=new $t,Au=new $t,To=[],Ru=new Di,ag=new $t,er=new de,ir=new qi,Ms=class extends de{constructor(t,e,i){super(t,e),this.isInstancedMesh=!0,this.instanceMatrix=new xr(new Float32Array(i*16),16),this.instanceColor=null,this.morphTexture=null,this.count=i,this.boundingBox=null,this.boundingSphere=null;for(let s=0;s<i;s++)this.setMatrixAt(s,ag)}computeBoundingBox(){let t=this.geometry,e=this.count;this.boundingBox===null&&(this.boundingBox=new Di),t.boundingBox===null&&t.computeBoundingBox(),this.boundingBox.makeEmpty();for(let i=0;i<e;i++)this.getMatrixAt(i,ds),Ru.copy(t.boundingBox).applyMatrix4(ds),this.boundingBox.union(Ru)}computeBoundingSphere(){let t=this.geometry,e=this.count;this.boundingSphere===null&&(this.boundingSphere=new qi),t.boundingSphere===null&&t.computeBoundingSphere(),this.boundingSphere.makeEmpty();for(let i=0;i<e;i++)this.getMatrixAt(i,ds),ir.copy(t.boundingSphere).applyMatrix4(ds),this.boundingSphere.union(ir)}copy(t,e){return super.copy(t,e),this.instanceMatrix.copy(t.instanceMatrix),this.morphTexture=t.morphTexture!==null?t.morphTexture.clone():null,this.instanceColor=t.instanceColor!==null?t.instanceColor.clone():null,this.count=t.count,this.boundingBox=t.boundingBox!==null?t.boundingBox.clone():null,this.boundingSphere=t.boundingSphere!==null?t.boundingSphere.clone():null,this}getColorAt(t,e){return this.instanceColor===null?e.setRGB(1,1,1):e.fromArray(this.instanceColor.array,t*3)}getMatrixAt(t,e){return e.fromArray(this.instanceMatrix.array,t*16)}getMorphAt(t,e){let i=e.morphTargetInfluences,s=this.morphTexture.source.data.data,r=i.length+1,o=t*r+1;for(let a=0;a<i.length;a++)i[a]=s[o+a]}raycast(t,e){let i=this.matrixWorld,s=this.count;if(er.geometry=this.geometry,er.material=this.material,er.material!==void 0&&(this.boundingSphere===null&&this.computeBoundingSphere(),ir.copy(this.boundingSphere),ir.applyMatrix4(i),t.ray.intersectsSphere(ir)!==!1))for(let r=0;r<s;r++){this.getMatrixAt(r,ds),Au.multiplyMatrices(i,ds),er.matrixWorld=Au,er.raycast(t,To);for(let o=0,a=To.length;o<a;o++){let l=To[o];l.instanceId=r,l.object=this,e.push(l)}To.length=0}}setColorAt(t,e){return this.instanceColor===null&&(this.instanceColor=new xr(new Float32Array(this.instanceMatrix.count*3).fill(1),3)),e.toArray(this.instanceColor.array,t*3),this}setMatrixAt(t,e){return e.toArray(this.instanceMatrix.array,t*16),this}setMorphAt(t,e){let i=e.morphTargetInfluences,s=i.length+1;this.morphTexture===null&&(this.morphTexture=new gr(new Float32Array(s*this.count),s,this.count,ba,xi));let r=this.morphTexture.source.data.data,o=0;for(let c=0;c<i.length;c++)o+=i[c];let a=this.geometry.morphTargetsRelative?1:1-o,l=s*t;return r[l]=a,r.set(i,l+1),this}updateMorphTargets(){}dispose(){super.dispose(),this.instanceMatrix.dispose(),this.instanceColor!==null&&this.instanceColor.dispose(),this.morphTexture!==null&&(this.morphTexture.dispose(),this.morphTexture=null)}},Dn=new qi,lg=new Lt(.5,.5),Ao=new N,dn=class{constructor(t=new ai,e=new ai,i=new ai,s=new ai,r=new ai,o=new ai){this.planes=[t,e,i,s,r,o]}set(t,e,i,s,r,o){let a=this.planes;return a[0].copy(t),a[1].copy(e),a[2].copy(i),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(t){let e=this.planes;for(let i=0;i<6;i++)e[i].copy(t.planes[i]);return this}setFromProjectionMatrix(t,e=gi,i=!1){let s=this.planes,r=t.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],u=r[5],d=r[6],f=r[7],p=r[8],_=r[9],g=r[10],m=r[11],b=r[12],S=r[13],w=r[14],E=r[15];if(s[0].setComponents(c-o,f-h,m-p,E-b).normalize(),s[1].setComponents(c+o,f+h,m+p,E+b).normalize(),s[2].setComponents(c+a,f+u,m+_,E+S).normalize(),s[3].setComponents(c-a,f-u,m-_,E-S).normalize(),i)s[4].setComponents(l,d,g,w).normalize(),s[5].setComponents(c-l,f-d,m-g,E-w).normalize();else if(s[4].setComponents(c-l,f-d,m-g,E-w).normalize(),e===gi)s[5].setComponents(c+l,f+d,m+g,E+w).normalize();else if(e===_s)s[5].setComponents(l,d,g,w).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+e);return this}intersectsObject(t){if(t.boundingSphere!==void 0)t.boundingSphere===null&&t.computeBoundingSphere(),Dn.copy(t.boundingSphere).applyMatrix4(t.matrixWorld);else{let e=t.geometry;e.boundingSphere===null&&e.computeBoundingSphere(),Dn.copy(e.boundingSphere).applyMatrix4(t.matrixWorld)}return this.intersectsSphere(Dn)}intersectsSprite(t){Dn.center.set(0,0,0);let e=lg.distanceTo(t.center);return Dn.radius=.7071067811865476+e,Dn.applyMatrix4(t.matrixWorld),this.intersectsSphere(Dn)}intersectsSphere(t){let e=this.planes,i=t.center,s=-t.radius;for(let r=0;r<6;r++)if(e[r].distanceToPoint(i)<s)return!1;return!0}intersectsBox(t){let e=this.planes;for(let i=0;i<6;i++){let s=e[i];if(Ao.x=s.normal.x>0?t.max.x:t.min.x,Ao.y=s.normal.y>0?t.max.y:t.min.y,Ao.z=s.normal.z>0?t.max.z:t.min.z,s.distanceToPoint(Ao)<0)return!1}return!0}containsPoint(t){let e=this.planes;for(let i=0;i<6;i++)if(e[i].distanceToPoint(t)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},Cu=new $t,Yo=class n{constructor(){this.coordinateSystem=gi,this._frustums=[],this._count=0}setFromArrayCamera(t){let e=t.cameras,i=this._frustums;for(let s=0;s<e.length;s++){let r=e[s];Cu.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),i[s]===void 0&&(i[s]=new dn),i[s].setFromProjectionMatrix(Cu,r.coordinateSystem,r.reversedDepth)}return this._count=e.length,this}getFrustum(t){return this._frustums[t]}intersectsObject(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsObject(t))return!0;return!1}intersectsSprite(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSprite(t))return!0;return!1}intersectsSphere(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsSphere(t))return!0;return!1}intersectsBox(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].intersectsBox(t))return!0;return!1}containsPoint(t){let e=this._frustums;for(let i=0;i<this._count;i++)if(e[i].containsPoint(t))return!0;return!1}copy(t){this.coordinateSystem=t.coordinateSystem;let e=this._frustums,i=t._frustums;for(let s=0;s<t._count;s++)e[s]===void 0&&(e[s]=new dn),e[s].copy(i[s]);return this._count=t._count,this}clone(){return new n().copy(this)}};var Ss=class extends $i{constructor(t){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new Pt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.linewidth=t.linewidth,this.linecap=t.linecap,this.linejoin=t.linejoin,this.fog=t.fog,this}},Zo=new N,Jo=new N,Pu=new $t,nr=new Nn,Ro=new qi,fc=new N,Iu=new N,Ko=class extends Be{constructor(t=new ue,e=new Ss){super(),this.isLine=!0,this.type="Line",this.geometry=t,this.material=e,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(t,e){return super.copy(t,e),t.morphTargetInfluences!==void 0?this.morphTargetInfluences=t.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,t.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},t.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(t.material)?t.material.slice():t.material,this.geometry=t.geometry,this}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[0];for(let s=1,r=e.count;s<r;s++)Zo.fromBufferAttribute(e,s-1),Jo.fromBufferAttribute(e,s),i[s]=i[s-1],i[s]+=Zo.distanceTo(Jo);t.setAttribute("lineDistance",new Jt(i,1))}else At("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(t){return t.intersectsObject(this)}raycast(t,e){let i=this.geometry,s=this.matrixWorld,r=t.params.Line.threshold,o=i.drawRange;if(i.boundingSphere===null&&i.computeBoundingSphere(),Ro.copy(i.boundingSphere),Ro.applyMatrix4(s),Ro.radius+=r,t.ray.intersectsSphere(Ro)===!1)return;Pu.copy(s).invert(),nr.copy(t.ray).applyMatrix4(Pu);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=i.index,d=i.attributes.position;if(h!==null){let f=Math.max(0,o.start),p=Math.min(h.count,o.start+o.count);for(let _=f,g=p-1;_<g;_+=c){let m=h.getX(_),b=h.getX(_+1),S=Co(this,t,nr,l,m,b,_);S&&e.push(S)}if(this.isLineLoop){let _=h.getX(p-1),g=h.getX(f),m=Co(this,t,nr,l,_,g,p-1);m&&e.push(m)}}else{let f=Math.max(0,o.start),p=Math.min(d.count,o.start+o.count);for(let _=f,g=p-1;_<g;_+=c){let m=Co(this,t,nr,l,_,_+1,_);m&&e.push(m)}if(this.isLineLoop){let _=Co(this,t,nr,l,p-1,f,p-1);_&&e.push(_)}}}updateMorphTargets(){let e=this.geometry.morphAttributes,i=Object.keys(e);if(i.length>0){let s=e[i[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Co(n,t,e,i,s,r,o){let a=n.geometry.attributes.position;if(Zo.fromBufferAttribute(a,s),Jo.fromBufferAttribute(a,r),e.distanceSqToSegment(Zo,Jo,fc,Iu)>i)return;fc.applyMatrix4(n.matrixWorld);let c=t.ray.origin.distanceTo(fc);if(!(c<t.near||c>t.far))return{distance:c,point:Iu.clone().applyMatrix4(n.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:n}}var Lu=new N,Du=new N,On=class extends Ko{constructor(t,e){super(t,e),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let t=this.geometry;if(t.index===null){let e=t.attributes.position,i=[];for(let s=0,r=e.count;s<r;s+=2)Lu.fromBufferAttribute(e,s),Du.fromBufferAttribute(e,s+1),i[s]=s===0?0:i[s-1],i[s+1]=i[s]+Lu.distanceTo(Du);t.setAttribute("lineDistance",new Jt(i,1))}else At("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var _r=class extends ti{constructor(t=[],e=Gn,i,s,r,o,a,l,c,h){super(t,e,i,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(t){this.image=t}};var Yi=class extends ti{constructor(t,e,i=Ei,s,r,o,a=Ue,l=Ue,c,h=Wi,u=1){if(h!==Wi&&h!==Ki)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let d={width:t,height:e,depth:u};super(d,s,r,o,a,l,h,i,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(t){return super.copy(t),this.source=new bs(Object.assign({},t.image)),this.compareFunction=t.compareFunction,this}toJSON(t){let e=super.toJSON(t);return e.compareFunction=this.compareFunction,e}},yr=class extends Yi{constructor(t,e=Ei,i=Gn,s,r,o=Ue,a=Ue,l,c=Wi){let h={width:t,height:t,depth:1},u=[h,h,h,h,h,h];super(t,t,e,i,s,r,o,a,l,c),this.image=u,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(t){this.image=t}},vr=class extends ti{constructor(t=null){super(),this.sourceTexture=t,this.isExternalTexture=!0}copy(t){return super.copy(t),this.sourceTexture=t.sourceTexture,this}},fn=class n extends ue{constructor(t=1,e=1,i=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:t,height:e,depth:i,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],u=[],d=0,f=0;p("z","y","x",-1,-1,i,e,t,o,r,0),p("z","y","x",1,-1,i,e,-t,o,r,1),p("x","z","y",1,1,t,i,e,s,o,2),p("x","z","y",1,-1,t,i,-e,s,o,3),p("x","y","z",1,-1,t,e,i,s,r,4),p("x","y","z",-1,-1,t,e,-i,s,r,5),this.setIndex(l),this.setAttribute("position",new Jt(c,3)),this.setAttribute("normal",new Jt(h,3)),this.setAttribute("uv",new Jt(u,2));function p(_,g,m,b,S,w,E,T,x,M,D){let P=w/x,U=E/M,F=w/2,W=E/2,I=T/2,H=x+1,$=M+1,G=0,et=0,X=new N;for(let Q=0;Q<$;Q++){let tt=Q*U-W;for(let wt=0;wt<H;wt++){let Ot=wt*P-F;X[_]=Ot*b,X[g]=tt*S,X[m]=I,c.push(X.x,X.y,X.z),X[_]=0,X[g]=0,X[m]=T>0?1:-1,h.push(X.x,X.y,X.z),u.push(wt/x),u.push(1-Q/M),G+=1}}for(let Q=0;Q<M;Q++)for(let tt=0;tt<x;tt++){let wt=d+tt+H*Q,Ot=d+tt+H*(Q+1),J=d+(tt+1)+H*(Q+1),mt=d+(tt+1)+H*Q;l.push(wt,Ot,mt),l.push(Ot,J,mt),et+=6}a.addGroup(f,et,D),f+=et,d+=G}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.depth,t.widthSegments,t.heightSegments,t.depthSegments)}};var pn=class n extends ue{constructor(t=1,e=1,i=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:t,radiusBottom:e,height:i,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],u=[],d=[],f=[],p=0,_=[],g=i/2,m=0;b(),o===!1&&(t>0&&S(!0),e>0&&S(!1)),this.setIndex(h),this.setAttribute("position",new Jt(u,3)),this.setAttribute("normal",new Jt(d,3)),this.setAttribute("uv",new Jt(f,2));function b(){let w=new N,E=new N,T=0,x=(e-t)/i;for(let M=0;M<=r;M++){let D=[],P=M/r,U=P*(e-t)+t;for(let F=0;F<=s;F++){let W=F/s,I=W*l+a,H=Math.sin(I),$=Math.cos(I);E.x=U*H,E.y=-P*i+g,E.z=U*$,u.push(E.x,E.y,E.z),w.set(H,x,$).normalize(),d.push(w.x,w.y,w.z),f.push(W,1-P),D.push(p++)}_.push(D)}for(let M=0;M<s;M++)for(let D=0;D<r;D++){let P=_[D][M],U=_[D+1][M],F=_[D+1][M+1],W=_[D][M+1];(t>0||D!==0)&&(h.push(P,U,W),T+=3),(e>0||D!==r-1)&&(h.push(U,F,W),T+=3)}c.addGroup(m,T,0),m+=T}function S(w){let E=p,T=new Lt,x=new N,M=0,D=w===!0?t:e,P=w===!0?1:-1;for(let F=1;F<=s;F++)u.push(0,g*P,0),d.push(0,P,0),f.push(.5,.5),p++;let U=p;for(let F=0;F<=s;F++){let I=F/s*l+a,H=Math.cos(I),$=Math.sin(I);x.x=D*$,x.y=g*P,x.z=D*H,u.push(x.x,x.y,x.z),d.push(0,P,0),T.x=H*.5+.5,T.y=$*.5*P+.5,f.push(T.x,T.y),p++}for(let F=0;F<s;F++){let W=E+F,I=U+F;w===!0?h.push(I,I+1,W):h.push(I+1,I,W),M+=3}c.addGroup(m,M,w===!0?1:2),m+=M}}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radiusTop,t.radiusBottom,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}},br=class n extends pn{constructor(t=1,e=1,i=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,t,e,i,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:t,height:e,radialSegments:i,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(t){return new n(t.radius,t.height,t.radialSegments,t.heightSegments,t.openEnded,t.thetaStart,t.thetaLength)}};var jo=class{constructor(){this.type="Curve",this.arcLengthDivisions=200,this.needsUpdate=!1,this.cacheArcLengths=null}getPoint(){At("Curve: .getPoint() not implemented.")}getPointAt(t,e){let i=this.getUtoTmapping(t);return this.getPoint(i,e)}getPoints(t=5){let e=[];for(let i=0;i<=t;i++)e.push(this.getPoint(i/t));return e}getSpacedPoints(t=5){let e=[];for(let i=0;i<=t;i++)e.push(this.getPointAt(i/t));return e}getLength(){let t=this.getLengths();return t[t.length-1]}getLengths(t=this.arcLengthDivisions){if(this.cacheArcLengths&&this.cacheArcLengths.length===t+1&&!this.needsUpdate)return this.cacheArcLengths;this.needsUpdate=!1;let e=[],i,s=this.getPoint(0),r=0;e.push(0);for(let o=1;o<=t;o++)i=this.getPoint(o/t),r+=i.distanceTo(s),e.push(r),s=i;return this.cacheArcLengths=e,e}updateArcLengths(){this.needsUpdate=!0,this.getLengths()}getUtoTmapping(t,e=null){let i=this.getLengths(),s=0,r=i.length,o;e?o=e:o=t*i[r-1];let a=0,l=r-1,c;for(;a<=l;)if(s=Math.floor(a+(l-a)/2),c=i[s]-o,c<0)a=s+1;else if(c>0)l=s-1;else{l=s;break}if(s=l,i[s]===o)return s/(r-1);let h=i[s],d=i[s+1]-h,f=(o-h)/d;return(s+f)/(r-1)}getTangent(t,e){let s=t-1e-4,r=t+1e-4;s<0&&(s=0),r>1&&(r=1);let o=this.getPoint(s),a=this.getPoint(r),l=e||(o.isVector2?new Lt:new N);return l.copy(a).sub(o).normalize(),l}getTangentAt(t,e){let i=this.getUtoTmapping(t);return this.getTangent(i,e)}computeFrenetFrames(t,e=!1){let i=new N,s=[],r=[],o=[],a=new N,l=new $t;for(let f=0;f<=t;f++){let p=f/t;s[f]=this.getTangentAt(p,new N)}r[0]=new N,o[0]=new N;let c=Number.MAX_VALUE,h=Math.abs(s[0].x),u=Math.abs(s[0].y),d=Math.abs(s[0].z);h<=c&&(c=h,i.set(1,0,0)),u<=c&&(c=u,i.set(0,1,0)),d<=c&&i.set(0,0,1),a.crossVectors(s[0],i).normalize(),r[0].crossVectors(s[0],a),o[0].crossVectors(s[0],r[0]);for(let f=1;f<=t;f++){if(r[f]=r[f-1].clone(),o[f]=o[f-1].clone(),a.crossVectors(s[f-1],s[f]),a.length()>Number.EPSILON){a.normalize();let p=Math.acos(Ht(s[f-1].dot(s[f]),-1,1));r[f].applyMatrix4(l.makeRotationAxis(a,p))}o[f].crossVectors(s[f],r[f])}if(e===!0){let f=Math.acos(Ht(r[0].dot(r[t]),-1,1));f/=t,s[0].dot(a.crossVectors(r[0],r[t]))>0&&(f=-f);for(let p=1;p<=t;p++)r[p].applyMatrix4(l.makeRotationAxis(s[p],f*p)),o[p].crossVectors(s[p],r[p])}return{tangents:s,normals:r,binormals:o}}clone(){return new this.constructor().copy(this)}copy(t){return this.arcLengthDivisions=t.arcLengthDivisions,this.cacheArcLengths=null,this}toJSON(){let t={metadata:{version:4.7,type:"Curve",generator:"Curve.toJSON"}};return t.arcLengthDivisions=this.arcLengthDivisions,t.type=this.type,t}fromJSON(t){return this.arcLengthDivisions=t.arcLengthDivisions,this.cacheArcLengths=null,this}};function th(){let n=0,t=0,e=0,i=0;function s(r,o,a,l){n=r,t=a,e=-3*r+3*o-2*a-l,i=2*r-2*o+a+l}return{initCatmullRom:function(r,o,a,l,c){s(o,a,c*(a-r),c*(l-o))},initNonuniformCatmullRom:function(r,o,a,l,c,h,u){let d=(o-r)/c-(a-r)/(c+h)+(a-o)/h,f=(a-o)/h-(l-o)/(h+u)+(l-a)/u;d*=h,f*=h,s(o,a,d,f)},calc:function(r){let o=r*r,a=o*r;return n+t*r+e*o+i*a}}}var Nu=new N,Uu=new N,pc=new th,mc=new th,gc=new th,wr=class extends jo{constructor(t=[],e=!1,i="centripetal",s=.5){super(),this.isCatmullRomCurve3=!0,this.type="CatmullRomCurve3",this.points=t,this.closed=e,this.curveType=i,this.tension=s}getPoint(t,e=new N){let i=e,s=this.points,r=s.length,o=(r-(this.closed?0:1))*t,a=Math.floor(o),l=o-a;this.closed?a+=a>0?0:(Math.floor(Math.abs(a)/r)+1)*r:l===0&&a===r-1&&(a=r-2,l=1);let c,h;this.closed||a>0?c=s[(a-1)%r]:(Uu.subVectors(s[0],s[1]).add(s[0]),c=Uu);let u=s[a%r],d=s[(a+1)%r];if(this.closed||a+2<r?h=s[(a+2)%r]:(Nu.subVectors(s[r-1],s[r-2]).add(s[r-1]),h=Nu),this.curveType==="centripetal"||this.curveType==="chordal"){let f=this.curveType==="chordal"?.5:.25,p=Math.pow(c.distanceToSquared(u),f),_=Math.pow(u.distanceToSquared(d),f),g=Math.pow(d.distanceToSquared(h),f);_<1e-4&&(_=1),p<1e-4&&(p=_),g<1e-4&&(g=_),pc.initNonuniformCatmullRom(c.x,u.x,d.x,h.x,p,_,g),mc.initNonuniformCatmullRom(c.y,u.y,d.y,h.y,p,_,g),gc.initNonuniformCatmullRom(c.z,u.z,d.z,h.z,p,_,g)}else this.curveType==="catmullrom"&&(pc.initCatmullRom(c.x,u.x,d.x,h.x,this.tension),mc.initCatmullRom(c.y,u.y,d.y,h.y,this.tension),gc.initCatmullRom(c.z,u.z,d.z,h.z,this.tension));return i.set(pc.calc(l),mc.calc(l),gc.calc(l)),i}copy(t){super.copy(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let s=t.points[e];this.points.push(s.clone())}return this.closed=t.closed,this.curveType=t.curveType,this.tension=t.tension,this}toJSON(){let t=super.toJSON();t.points=[];for(let e=0,i=this.points.length;e<i;e++){let s=this.points[e];t.points.push(s.toArray())}return t.closed=this.closed,t.curveType=this.curveType,t.tension=this.tension,t}fromJSON(t){super.fromJSON(t),this.points=[];for(let e=0,i=t.points.length;e<i;e++){let s=t.points[e];this.points.push(new N().fromArray(s))}return this.closed=t.closed,this.curveType=t.curveType,this.tension=t.tension,this}};var Fn=class n extends ue{constructor(t=1,e=1,i=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:t,height:e,widthSegments:i,heightSegments:s};let r=t/2,o=e/2,a=Math.floor(i),l=Math.floor(s),c=a+1,h=l+1,u=t/a,d=e/l,f=[],p=[],_=[],g=[];for(let m=0;m<h;m++){let b=m*d-o;for(let S=0;S<c;S++){let w=S*u-r;p.push(w,-b,0),_.push(0,0,1),g.push(S/a),g.push(1-m/l)}}for(let m=0;m<l;m++)for(let b=0;b<a;b++){let S=b+c*m,w=b+c*(m+1),E=b+1+c*(m+1),T=b+1+c*m;f.push(S,w,T),f.push(w,E,T)}this.setIndex(f),this.setAttribute("position",new Jt(p,3)),this.setAttribute("normal",new Jt(_,3)),this.setAttribute("uv",new Jt(g,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.width,t.height,t.widthSegments,t.heightSegments)}};var Bn=class n extends ue{constructor(t=1,e=32,i=16,s=0,r=Math.PI*2,o=0,a=Math.PI){super(),this.type="SphereGeometry",this.parameters={radius:t,widthSegments:e,heightSegments:i,phiStart:s,phiLength:r,thetaStart:o,thetaLength:a},e=Math.max(3,Math.floor(e)),i=Math.max(2,Math.floor(i));let l=Math.min(o+a,Math.PI),c=0,h=[],u=new N,d=new N,f=[],p=[],_=[],g=[];for(let m=0;m<=i;m++){let b=[],S=m/i,w=o+S*a,E=t*Math.cos(w),T=Math.sqrt(t*t-E*E),x=0;m===0&&o===0?x=.5/e:m===i&&l===Math.PI&&(x=-.5/e);for(let M=0;M<=e;M++){let D=M/e,P=s+D*r;u.x=-T*Math.cos(P),u.y=E,u.z=T*Math.sin(P),p.push(u.x,u.y,u.z),d.copy(u).normalize(),_.push(d.x,d.y,d.z),g.push(D+x,1-S),b.push(c++)}h.push(b)}for(let m=0;m<i;m++)for(let b=0;b<e;b++){let S=h[m][b+1],w=h[m][b],E=h[m+1][b],T=h[m+1][b+1];(m!==0||o>0)&&f.push(S,w,T),(m!==i-1||l<Math.PI)&&f.push(w,E,T)}this.setIndex(f),this.setAttribute("position",new Jt(p,3)),this.setAttribute("normal",new Jt(_,3)),this.setAttribute("uv",new Jt(g,2))}copy(t){return super.copy(t),this.parameters=Object.assign({},t.parameters),this}static fromJSON(t){return new n(t.radius,t.widthSegments,t.heightSegments,t.phiStart,t.phiLength,t.thetaStart,t.thetaLength)}};function Wn(n){let t={};for(let e in n){t[e]={};for(let i in n[e]){let s=n[e][i];if(Ou(s))s.isRenderTargetTexture?(At("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),t[e][i]=null):t[e][i]=s.clone();else if(Array.isArray(s))if(Ou(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();t[e][i]=r}else t[e][i]=s.slice();else t[e][i]=s}}return t}function qe(n){let t={};for(let e=0;e<n.length;e++){let i=Wn(n[e]);for(let s in i)t[s]=i[s]}return t}function Ou(n){return n&&(n.isColor||n.isMatrix3||n.isMatrix4||n.isVector2||n.isVector3||n.isVector4||n.isTexture||n.isQuaternion)}function cg(n){let t=[];for(let e=0;e<n.length;e++)t.push(n[e].clone());return t}function eh(n){let t=n.getRenderTarget();return t===null?n.outputColorSpace:t.isXRRenderTarget===!0?t.texture.colorSpace:qt.workingColorSpace}var Cd={clone:Wn,merge:qe},hg=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,ug=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Xe=class extends $i{constructor(t){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=hg,this.fragmentShader=ug,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,t!==void 0&&this.setValues(t)}copy(t){return super.copy(t),this.fragmentShader=t.fragmentShader,this.vertexShader=t.vertexShader,this.uniforms=Wn(t.uniforms),this.uniformsGroups=cg(t.uniformsGroups),this.defines=Object.assign({},t.defines),this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.fog=t.fog,this.lights=t.lights,this.clipping=t.clipping,this.extensions=Object.assign({},t.extensions),this.glslVersion=t.glslVersion,this.defaultAttributeValues=Object.assign({},t.defaultAttributeValues),this.index0AttributeName=t.index0AttributeName,this.uniformsNeedUpdate=t.uniformsNeedUpdate,this}toJSON(t){let e=super.toJSON(t);e.glslVersion=this.glslVersion,e.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?e.uniforms[s]={type:"t",value:o.toJSON(t).uuid}:o&&o.isColor?e.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?e.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?e.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?e.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?e.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?e.uniforms[s]={type:"m4",value:o.toArray()}:e.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(e.defines=this.defines),e.vertexShader=this.vertexShader,e.fragmentShader=this.fragmentShader,e.lights=this.lights,e.clipping=this.clipping;let i={};for(let s in this.extensions)this.extensions[s]===!0&&(i[s]=!0);return Object.keys(i).length>0&&(e.extensions=i),e}fromJSON(t,e){if(super.fromJSON(t,e),t.uniforms!==void 0)for(let i in t.uniforms){let s=t.uniforms[i];switch(this.uniforms[i]={},s.type){case"t":this.uniforms[i].value=e[s.value]||null;break;case"c":this.uniforms[i].value=new Pt().setHex(s.value);break;case"v2":this.uniforms[i].value=new Lt().fromArray(s.value);break;case"v3":this.uniforms[i].value=new N().fromArray(s.value);break;case"v4":this.uniforms[i].value=new he().fromArray(s.value);break;case"m3":this.uniforms[i].value=new Nt().fromArray(s.value);break;case"m4":this.uniforms[i].value=new $t().fromArray(s.value);break;default:this.uniforms[i].value=s.value}}if(t.defines!==void 0&&(this.defines=t.defines),t.vertexShader!==void 0&&(this.vertexShader=t.vertexShader),t.fragmentShader!==void 0&&(this.fragmentShader=t.fragmentShader),t.glslVersion!==void 0&&(this.glslVersion=t.glslVersion),t.extensions!==void 0)for(let i in t.extensions)this.extensions[i]=t.extensions[i];return t.lights!==void 0&&(this.lights=t.lights),t.clipping!==void 0&&(this.clipping=t.clipping),this}},Qo=class extends Xe{constructor(t){super(t),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Zi=class extends $i{constructor(t){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new Pt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new Pt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=el,this.normalScale=new Lt(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new Xi,this.combine=pa,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(t)}copy(t){return super.copy(t),this.color.copy(t.color),this.map=t.map,this.lightMap=t.lightMap,this.lightMapIntensity=t.lightMapIntensity,this.aoMap=t.aoMap,this.aoMapIntensity=t.aoMapIntensity,this.emissive.copy(t.emissive),this.emissiveMap=t.emissiveMap,this.emissiveIntensity=t.emissiveIntensity,this.bumpMap=t.bumpMap,this.bumpScale=t.bumpScale,this.normalMap=t.normalMap,this.normalMapType=t.normalMapType,this.normalScale.copy(t.normalScale),this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.specularMap=t.specularMap,this.alphaMap=t.alphaMap,this.envMap=t.envMap,this.envMapRotation.copy(t.envMapRotation),this.combine=t.combine,this.reflectivity=t.reflectivity,this.envMapIntensity=t.envMapIntensity,this.refractionRatio=t.refractionRatio,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this.wireframeLinecap=t.wireframeLinecap,this.wireframeLinejoin=t.wireframeLinejoin,this.flatShading=t.flatShading,this.fog=t.fog,this}},ta=class extends $i{constructor(t){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=fd,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(t)}copy(t){return super.copy(t),this.depthPacking=t.depthPacking,this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this.wireframe=t.wireframe,this.wireframeLinewidth=t.wireframeLinewidth,this}},ea=class extends $i{constructor(t){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(t)}copy(t){return super.copy(t),this.map=t.map,this.alphaMap=t.alphaMap,this.displacementMap=t.displacementMap,this.displacementScale=t.displacementScale,this.displacementBias=t.displacementBias,this}};function fs(n,t){return!n||n.constructor===t?n:typeof t.BYTES_PER_ELEMENT=="number"?new t(n):Array.prototype.slice.call(n)}function Po(n){return n!==void 0&&n.inTangents!==void 0&&n.outTangents!==void 0}var mn=class{constructor(t,e,i,s){this.parameterPositions=t,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new e.constructor(i),this.sampleValues=e,this.valueSize=i,this.settings=null,this.DefaultSettings_={}}evaluate(t){let e=this.parameterPositions,i=this._cachedIndex,s=e[i],r=e[i-1];t:{e:{let o;i:{n:if(!(t<s)){for(let a=i+2;;){if(s===void 0){if(t<r)break n;return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}if(i===a)break;if(r=s,s=e[++i],t<s)break e}o=e.length;break i}if(!(t>=r)){let a=e[1];t<a&&(i=2,r=a);for(let l=i-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(i===l)break;if(s=r,r=e[--i-1],t>=r)break e}o=i,i=0;break i}break t}for(;i<o;){let a=i+o>>>1;t<e[a]?o=a:i=a+1}if(s=e[i],r=e[i-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return i=e.length,this._cachedIndex=i,this.copySampleValue_(i-1)}this._cachedIndex=i,this.intervalChanged_(i,r,s)}return this.interpolate_(i,r,t,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(t){let e=this.resultBuffer,i=this.sampleValues,s=this.valueSize,r=t*s;for(let o=0;o!==s;++o)e[o]=i[r+o];return e}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},ia=class extends mn{constructor(t,e,i,s){super(t,e,i,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:yc,endingEnd:yc}}intervalChanged_(t,e,i){let s=this.parameterPositions,r=t-2,o=t+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case vc:r=t,a=2*e-i;break;case bc:r=s.length-2,a=e+s[r]-s[r+1];break;default:r=t,a=i}if(l===void 0)switch(this.getSettings_().endingEnd){case vc:o=t,l=2*i-e;break;case bc:o=1,l=i+s[1]-s[0];break;default:o=t-1,l=e}let c=(i-e)*.5,h=this.valueSize;this._weightPrev=c/(e-a),this._weightNext=c/(l-i),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this._offsetPrev,u=this._offsetNext,d=this._weightPrev,f=this._weightNext,p=(i-e)/(s-e),_=p*p,g=_*p,m=-d*g+2*d*_-d*p,b=(1+d)*g+(-1.5-2*d)*_+(-.5+d)*p+1,S=(-1-f)*g+(1.5+f)*_+.5*p,w=f*g-f*_;for(let E=0;E!==a;++E)r[E]=m*o[h+E]+b*o[c+E]+S*o[l+E]+w*o[u+E];return r}},na=class extends mn{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=(i-e)/(s-e),u=1-h;for(let d=0;d!==a;++d)r[d]=o[c+d]*u+o[l+d]*h;return r}},sa=class extends mn{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t){return this.copySampleValue_(t-1)}},ra=class extends mn{interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=t*a,c=l-a,h=this.inTangents,u=this.outTangents;if(!h||!u){let p=(i-e)/(s-e),_=1-p;for(let g=0;g!==a;++g)r[g]=o[c+g]*_+o[l+g]*p;return r}let d=a*2,f=t-1;for(let p=0;p!==a;++p){let _=o[c+p],g=o[l+p],m=f*d+p*2,b=u[m],S=u[m+1],w=t*d+p*2,E=h[w],T=h[w+1],x=fg(i,e,b,E,s);r[p]=Pd(x,_,S,T,g)}return r}};function Pd(n,t,e,i,s){let r=1-n;return r*r*r*t+3*r*r*n*e+3*r*n*n*i+n*n*n*s}function dg(n,t,e,i,s){let r=1-n;return 3*r*r*(e-t)+6*r*n*(i-e)+3*n*n*(s-i)}function fg(n,t,e,i,s){let r=(n-t)/(s-t);for(let o=0;o<8;o++){let a=Pd(r,t,e,i,s)-n;if(Math.abs(a)<1e-10)break;let l=dg(r,t,e,i,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var li=class{constructor(t,e,i,s){if(t===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(e===void 0||e.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+t);this.name=t,this.times=fs(e,this.TimeBufferType),this.values=fs(i,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(t){let e=t.constructor,i;if(e.toJSON!==this.toJSON)i=e.toJSON(t);else{i={name:t.name,times:fs(t.times,Array),values:fs(t.values,Array)};let s=t.getInterpolation();s!==t.DefaultInterpolation&&(i.interpolation=s),Po(t.settings)&&(i.settings={inTangents:fs(t.settings.inTangents,Array),outTangents:fs(t.settings.outTangents,Array)})}return i.type=t.ValueTypeName,i}InterpolantFactoryMethodDiscrete(t){return new sa(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodLinear(t){return new na(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodSmooth(t){return new ia(this.times,this.values,this.getValueSize(),t)}InterpolantFactoryMethodBezier(t){let e=new ra(this.times,this.values,this.getValueSize(),t);return this.settings&&(e.inTangents=this.settings.inTangents,e.outTangents=this.settings.outTangents),e}setInterpolation(t){let e;switch(t){case ar:e=this.InterpolantFactoryMethodDiscrete;break;case Wo:e=this.InterpolantFactoryMethodLinear;break;case Do:e=this.InterpolantFactoryMethodSmooth;break;case _c:e=this.InterpolantFactoryMethodBezier;break}if(e===void 0){let i="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(t!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(i);return At("KeyframeTrack:",i),this}return this.createInterpolant=e,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return ar;case this.InterpolantFactoryMethodLinear:return Wo;case this.InterpolantFactoryMethodSmooth:return Do;case this.InterpolantFactoryMethodBezier:return _c}}getValueSize(){return this.values.length/this.times.length}shift(t){if(t!==0){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]+=t;Po(this.settings)&&(Fu(this.settings.inTangents,t),Fu(this.settings.outTangents,t))}return this}scale(t){if(t!==1){let e=this.times;for(let i=0,s=e.length;i!==s;++i)e[i]*=t;Po(this.settings)&&(Bu(this.settings.inTangents,t),Bu(this.settings.outTangents,t))}return this}trim(t,e){let i=this.times,s=i.length,r=0,o=s-1;for(;r!==s&&i[r]<t;)++r;for(;o!==-1&&i[o]>e;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=i.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let t=!0,e=this.getValueSize();e-Math.floor(e)!==0&&(Dt("KeyframeTrack: Invalid value size in track.",this),t=!1);let i=this.times,s=this.values,r=i.length;r===0&&(Dt("KeyframeTrack: Track is empty.",this),t=!1);let o=null;for(let a=0;a!==r;a++){let l=i[a];if(typeof l=="number"&&isNaN(l)){Dt("KeyframeTrack: Time is not a valid number.",this,a,l),t=!1;break}if(o!==null&&o>l){Dt("KeyframeTrack: Out of order keys.",this,a,l,o),t=!1;break}o=l}if(s!==void 0&&Rm(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){Dt("KeyframeTrack: Value is not a valid number.",this,a,c),t=!1;break}}return t}optimize(){let t=this.times.slice(),e=this.values.slice(),i=this.getValueSize(),s=this.getInterpolation()===Do,r=t.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=t[a],h=t[a+1];if(c!==h&&(a!==1||c!==t[0]))if(s)l=!0;else{let u=a*i,d=u-i,f=u+i;for(let p=0;p!==i;++p){let _=e[u+p];if(_!==e[d+p]||_!==e[f+p]){l=!0;break}}}if(l){if(a!==o){t[o]=t[a];let u=a*i,d=o*i;for(let f=0;f!==i;++f)e[d+f]=e[u+f]}++o}}if(r>0){t[o]=t[r];for(let a=r*i,l=o*i,c=0;c!==i;++c)e[l+c]=e[a+c];++o}return o!==t.length?(this.times=t.slice(0,o),this.values=e.slice(0,o*i)):(this.times=t,this.values=e),this}clone(){let t=this.times.slice(),e=this.values.slice(),i=this.constructor,s=new i(this.name,t,e);return s.createInterpolant=this.createInterpolant,Po(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Fu(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]+=t}function Bu(n,t){for(let e=0,i=n.length;e!==i;e+=2)n[e]*=t}li.prototype.ValueTypeName="";li.prototype.TimeBufferType=Float32Array;li.prototype.ValueBufferType=Float32Array;li.prototype.DefaultInterpolation=Wo;var gn=class extends li{constructor(t,e,i){super(t,e,i)}};gn.prototype.ValueTypeName="bool";gn.prototype.ValueBufferType=Array;gn.prototype.DefaultInterpolation=ar;gn.prototype.InterpolantFactoryMethodLinear=void 0;gn.prototype.InterpolantFactoryMethodSmooth=void 0;var oa=class extends li{constructor(t,e,i,s){super(t,e,i,s)}};oa.prototype.ValueTypeName="color";var aa=class extends li{constructor(t,e,i,s){super(t,e,i,s)}};aa.prototype.ValueTypeName="number";var la=class extends mn{constructor(t,e,i,s){super(t,e,i,s)}interpolate_(t,e,i,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(i-e)/(s-e),c=t*a;for(let h=c+a;c!==h;c+=4)Je.slerpFlat(r,0,o,c-a,o,c,l);return r}},Mr=class extends li{constructor(t,e,i,s){super(t,e,i,s)}InterpolantFactoryMethodLinear(t){return new la(this.times,this.values,this.getValueSize(),t)}};Mr.prototype.ValueTypeName="quaternion";Mr.prototype.InterpolantFactoryMethodSmooth=void 0;var xn=class extends li{constructor(t,e,i){super(t,e,i)}};xn.prototype.ValueTypeName="string";xn.prototype.ValueBufferType=Array;xn.prototype.DefaultInterpolation=ar;xn.prototype.InterpolantFactoryMethodLinear=void 0;xn.prototype.InterpolantFactoryMethodSmooth=void 0;var ca=class extends li{constructor(t,e,i,s){super(t,e,i,s)}};ca.prototype.ValueTypeName="vector";var ha=class{constructor(t,e,i){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=t,this.onProgress=e,this.onError=i,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,u){return c.push(h,u),this},this.removeHandler=function(h){let u=c.indexOf(h);return u!==-1&&c.splice(u,2),this},this.getHandler=function(h){for(let u=0,d=c.length;u<d;u+=2){let f=c[u],p=c[u+1];if(f.global&&(f.lastIndex=0),f.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Id=new ha,ua=class{constructor(t){this.manager=t!==void 0?t:Id,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(t,e){let i=this;return new Promise(function(s,r){i.load(t,s,e,r)})}parse(){}setCrossOrigin(t){return this.crossOrigin=t,this}setWithCredentials(t){return this.withCredentials=t,this}setPath(t){return this.path=t,this}setResourcePath(t){return this.resourcePath=t,this}setRequestHeader(t){return this.requestHeader=t,this}setPriority(t){return this.priority=t,this}setCache(t){return this.cache=t,this}abort(){return this}};ua.DEFAULT_MATERIAL_NAME="__DEFAULT";var Sr=class extends Be{static registerNode(t){this.prototype._lightNode=t}constructor(t,e=1){super(),this.isLight=!0,this.type="Light",this.color=new Pt(t),this.intensity=e}copy(t,e){return super.copy(t,e),this.color.copy(t.color),this.intensity=t.intensity,this}toJSON(t){let e=super.toJSON(t);return e.object.color=this.color.getHex(),e.object.intensity=this.intensity,e}},Er=class extends Sr{constructor(t,e,i){super(t,i),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(Be.DEFAULT_UP),this.updateMatrix(),this.groundColor=new Pt(e)}copy(t,e){return super.copy(t,e),this.groundColor.copy(t.groundColor),this}toJSON(t){let e=super.toJSON(t);return e.object.groundColor=this.groundColor.getHex(),e}},xc=new $t,ku=new N,zu=new N,da=class{constructor(t){this.camera=t,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new Lt(512,512),this.mapType=ei,this.map=null,this.mapPass=null,this.matrix=new $t,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new dn,this._frameExtents=new Lt(1,1),this._viewportCount=1,this._viewports=[new he(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(t){let e=this.camera;ku.setFromMatrixPosition(t.matrixWorld),e.position.copy(ku),zu.setFromMatrixPosition(t.target.matrixWorld),e.lookAt(zu),e.updateMatrixWorld(),this._updateMatrix(e,this.matrix,this._frustum)}_updateMatrix(t,e,i,s){xc.multiplyMatrices(t.projectionMatrix,t.matrixWorldInverse),i.setFromProjectionMatrix(xc,t.coordinateSystem,t.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;t.coordinateSystem===_s||t.reversedDepth?e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):e.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),e.multiply(xc)}getViewport(t){return this._viewports[t]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(t){return this.camera=t.camera.clone(),this.intensity=t.intensity,this.bias=t.bias,this.radius=t.radius,this.autoUpdate=t.autoUpdate,this.needsUpdate=t.needsUpdate,this.normalBias=t.normalBias,this.blurSamples=t.blurSamples,this.mapSize.copy(t.mapSize),this.mapType=t.mapType,this.biasNode=t.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let t={};return t.intensity=this.intensity,t.bias=this.bias,t.normalBias=this.normalBias,t.radius=this.radius,t.blurSamples=this.blurSamples,t.mapSize=this.mapSize.toArray(),t.mapType=this.mapType,t.camera=this.camera.toJSON(!1).object,delete t.camera.matrix,t}},Io=new N,Lo=new Je,Ii=new N,kn=class extends Be{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new $t,this.projectionMatrix=new $t,this.projectionMatrixInverse=new $t,this.coordinateSystem=gi,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(t,e){return super.copy(t,e),this.matrixWorldInverse.copy(t.matrixWorldInverse),this.projectionMatrix.copy(t.projectionMatrix),this.projectionMatrixInverse.copy(t.projectionMatrixInverse),this.coordinateSystem=t.coordinateSystem,this}getWorldDirection(t){return super.getWorldDirection(t).negate()}updateMatrixWorld(t){super.updateMatrixWorld(t),this.matrixWorld.decompose(Io,Lo,Ii),Ii.x===1&&Ii.y===1&&Ii.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Io,Lo,Ii.set(1,1,1)).invert()}updateWorldMatrix(t,e,i=!1){super.updateWorldMatrix(t,e,i),this.matrixWorld.decompose(Io,Lo,Ii),Ii.x===1&&Ii.y===1&&Ii.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Io,Lo,Ii.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},hn=new N,Hu=new Lt,Gu=new Lt,Ye=class extends kn{constructor(t=50,e=1,i=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=t,this.zoom=1,this.near=i,this.far=s,this.focus=10,this.aspect=e,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.fov=t.fov,this.zoom=t.zoom,this.near=t.near,this.far=t.far,this.focus=t.focus,this.aspect=t.aspect,this.view=t.view===null?null:Object.assign({},t.view),this.filmGauge=t.filmGauge,this.filmOffset=t.filmOffset,this}setFocalLength(t){let e=.5*this.getFilmHeight()/t;this.fov=vs*2*Math.atan(e),this.updateProjectionMatrix()}getFocalLength(){let t=Math.tan(rr*.5*this.fov);return .5*this.getFilmHeight()/t}getEffectiveFOV(){return vs*2*Math.atan(Math.tan(rr*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(t,e,i){hn.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),e.set(hn.x,hn.y).multiplyScalar(-t/hn.z),hn.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),i.set(hn.x,hn.y).multiplyScalar(-t/hn.z)}getViewSize(t,e){return this.getViewBounds(t,Hu,Gu),e.subVectors(Gu,Hu)}setViewOffset(t,e,i,s,r,o){this.aspect=t/e,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=this.near,e=t*Math.tan(rr*.5*this.fov)/this.zoom,i=2*e,s=this.aspect*i,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,e-=o.offsetY*i/c,s*=o.width/l,i*=o.height/c}let a=this.filmOffset;a!==0&&(r+=t*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,e,e-i,t,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.fov=this.fov,e.object.zoom=this.zoom,e.object.near=this.near,e.object.far=this.far,e.object.focus=this.focus,e.object.aspect=this.aspect,this.view!==null&&(e.object.view=Object.assign({},this.view)),e.object.filmGauge=this.filmGauge,e.object.filmOffset=this.filmOffset,e}};var Tr=class extends kn{constructor(t=-1,e=1,i=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=t,this.right=e,this.top=i,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(t,e){return super.copy(t,e),this.left=t.left,this.right=t.right,this.top=t.top,this.bottom=t.bottom,this.near=t.near,this.far=t.far,this.zoom=t.zoom,this.view=t.view===null?null:Object.assign({},t.view),this}setViewOffset(t,e,i,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=t,this.view.fullHeight=e,this.view.offsetX=i,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let t=(this.right-this.left)/(2*this.zoom),e=(this.top-this.bottom)/(2*this.zoom),i=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=i-t,o=i+t,a=s+e,l=s-e;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(t){let e=super.toJSON(t);return e.object.zoom=this.zoom,e.object.left=this.left,e.object.right=this.right,e.object.top=this.top,e.object.bottom=this.bottom,e.object.near=this.near,e.object.far=this.far,this.view!==null&&(e.object.view=Object.assign({},this.view)),e}},wc=class extends da{constructor(){super(new Tr(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},Ar=class extends Sr{constructor(t,e){super(t,e),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(Be.DEFAULT_UP),this.updateMatrix(),this.target=new Be,this.shadow=new wc}dispose(){super.dispose(),this.shadow.dispose()}copy(t){return super.copy(t),this.target=t.target.clone(),this.shadow=t.shadow.clone(),this}toJSON(t){let e=super.toJSON(t);return e.object.shadow=this.shadow.toJSON(),e.object.target=this.target.uuid,e}};var ps=-90,ms=1,Es=class extends Be{constructor(t,e,i){super(),this.type="CubeCamera",this.renderTarget=i,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Ye(ps,ms,t,e);s.layers=this.layers,this.add(s);let r=new Ye(ps,ms,t,e);r.layers=this.layers,this.add(r);let o=new Ye(ps,ms,t,e);o.layers=this.layers,this.add(o);let a=new Ye(ps,ms,t,e);a.layers=this.layers,this.add(a);let l=new Ye(ps,ms,t,e);l.layers=this.layers,this.add(l);let c=new Ye(ps,ms,t,e);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let t=this.coordinateSystem,e=this.children.concat(),[i,s,r,o,a,l]=e;for(let c of e)this.remove(c);if(t===gi)i.up.set(0,1,0),i.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(t===_s)i.up.set(0,-1,0),i.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+t);for(let c of e)this.add(c),c.updateMatrixWorld()}update(t,e){this.parent===null&&this.updateMatrixWorld();let{renderTarget:i,activeMipmapLevel:s}=this;this.coordinateSystem!==t.coordinateSystem&&(this.coordinateSystem=t.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,u=t.getRenderTarget(),d=t.getActiveCubeFace(),f=t.getActiveMipmapLevel(),p=t.xr.enabled;t.xr.enabled=!1;let _=i.texture.mipmapsAutoUpdate;i.texture.mipmapsAutoUpdate=!1;let g=!1;t.isWebGLRenderer===!0?g=t.state.buffers.depth.getReversed():g=t.reversedDepthBuffer,t.setRenderTarget(i,0,s),g&&t.autoClear===!1&&t.clearDepth(),t.render(e,r),t.setRenderTarget(i,1,s),g&&t.autoClear===!1&&t.clearDepth(),t.render(e,o),t.setRenderTarget(i,2,s),g&&t.autoClear===!1&&t.clearDepth(),t.render(e,a),t.setRenderTarget(i,3,s),g&&t.autoClear===!1&&t.clearDepth(),t.render(e,l),t.setRenderTarget(i,4,s),g&&t.autoClear===!1&&t.clearDepth(),t.render(e,c),i.texture.mipmapsAutoUpdate=_,t.setRenderTarget(i,5,s),g&&t.autoClear===!1&&t.clearDepth(),t.render(e,h),t.setRenderTarget(u,d,f),t.xr.enabled=p,i.texture.needsPMREMUpdate=!0}},fa=class extends Ye{constructor(t=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=t,this.perCameraFrustumCulled=!1}};var ih="\\[\\]\\.:\\/",pg=new RegExp("["+ih+"]","g"),nh="[^"+ih+"]",mg="[^"+ih.replace("\\.","")+"]",gg=/((?:WC+[\/:])*)/.source.replace("WC",nh),xg=/(WCOD+)?/.source.replace("WCOD",mg),_g=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",nh),yg=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",nh),vg=new RegExp("^"+gg+xg+_g+yg+"$"),bg=["material","materials","bones","map"],Mc=class{constructor(t,e,i){let s=i||oe.parseTrackName(e);this._targetGroup=t,this._bindings=t.subscribe_(e,s)}getValue(t,e){this.bind();let i=this._targetGroup.nCachedObjects_,s=this._bindings[i];s!==void 0&&s.getValue(t,e)}setValue(t,e){let i=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=i.length;s!==r;++s)i[s].setValue(t,e)}bind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].bind()}unbind(){let t=this._bindings;for(let e=this._targetGroup.nCachedObjects_,i=t.length;e!==i;++e)t[e].unbind()}},oe=class n{constructor(t,e,i){this.path=e,this.parsedPath=i||n.parseTrackName(e),this.node=n.findNode(t,this.parsedPath.nodeName),this.rootNode=t,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(t,e,i){return t&&t.isAnimationObjectGroup?new n.Composite(t,e,i):new n(t,e,i)}static sanitizeNodeName(t){return t.replace(/\s/g,"_").replace(pg,"")}static parseTrackName(t){let e=vg.exec(t);if(e===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+t);let i={nodeName:e[2],objectName:e[3],objectIndex:e[4],propertyName:e[5],propertyIndex:e[6]},s=i.nodeName&&i.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=i.nodeName.substring(s+1);bg.indexOf(r)!==-1&&(i.nodeName=i.nodeName.substring(0,s),i.objectName=r)}if(i.propertyName===null||i.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+t);return i}static findNode(t,e){if(e===void 0||e===""||e==="."||e===-1||e===t.name||e===t.uuid)return t;if(t.skeleton){let i=t.skeleton.getBoneByName(e);if(i!==void 0)return i}if(t.children){let i=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===e||a.uuid===e)return a;let l=i(a.children);if(l)return l}return null},s=i(t.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(t,e){t[e]=this.targetObject[this.propertyName]}_getValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)t[e++]=i[s]}_getValue_arrayElement(t,e){t[e]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(t,e){this.resolvedProperty.toArray(t,e)}_setValue_direct(t,e){this.targetObject[this.propertyName]=t[e]}_setValue_direct_setNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(t,e){this.targetObject[this.propertyName]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++]}_setValue_array_setNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(t,e){let i=this.resolvedProperty;for(let s=0,r=i.length;s!==r;++s)i[s]=t[e++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(t,e){this.resolvedProperty[this.propertyIndex]=t[e]}_setValue_arrayElement_setNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty[this.propertyIndex]=t[e],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(t,e){this.resolvedProperty.fromArray(t,e)}_setValue_fromArray_setNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(t,e){this.resolvedProperty.fromArray(t,e),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(t,e){this.bind(),this.getValue(t,e)}_setValue_unbound(t,e){this.bind(),this.setValue(t,e)}bind(){let t=this.node,e=this.parsedPath,i=e.objectName,s=e.propertyName,r=e.propertyIndex;if(t||(t=n.findNode(this.rootNode,e.nodeName),this.node=t),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!t){At("PropertyBinding: No target node found for track: "+this.path+".");return}if(i){let c=e.objectIndex;switch(i){case"materials":if(!t.material){Dt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.materials){Dt("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}t=t.material.materials;break;case"bones":if(!t.skeleton){Dt("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}t=t.skeleton.bones;for(let h=0;h<t.length;h++)if(t[h].name===c){c=h;break}break;case"map":if("map"in t){t=t.map;break}if(!t.material){Dt("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!t.material.map){Dt("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}t=t.material.map;break;default:if(t[i]===void 0){Dt("PropertyBinding: Can not bind to objectName of node undefined.",this);return}t=t[i]}if(c!==void 0){if(t[c]===void 0){Dt("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,t);return}t=t[c]}}let o=t[s];if(o===void 0){let c=e.nodeName;Dt("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",t);return}let a=this.Versioning.None;this.targetObject=t,t.isMaterial===!0?a=this.Versioning.NeedsUpdate:t.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!t.geometry){Dt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!t.geometry.morphAttributes){Dt("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}t.morphTargetDictionary[r]!==void 0&&(r=t.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};oe.Composite=Mc;oe.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};oe.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};oe.prototype.GetterByBindingType=[oe.prototype._getValue_direct,oe.prototype._getValue_array,oe.prototype._getValue_arrayElement,oe.prototype._getValue_toArray];oe.prototype.SetterByBindingTypeAndVersioning=[[oe.prototype._setValue_direct,oe.prototype._setValue_direct_setNeedsUpdate,oe.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[oe.prototype._setValue_array,oe.prototype._setValue_array_setNeedsUpdate,oe.prototype._setValue_array_setMatrixWorldNeedsUpdate],[oe.prototype._setValue_arrayElement,oe.prototype._setValue_arrayElement_setNeedsUpdate,oe.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[oe.prototype._setValue_fromArray,oe.prototype._setValue_fromArray_setNeedsUpdate,oe.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var pM=new Float32Array(1);var Ts=class{constructor(t=1,e=0,i=0){this.radius=t,this.phi=e,this.theta=i}set(t,e,i){return this.radius=t,this.phi=e,this.theta=i,this}copy(t){return this.radius=t.radius,this.phi=t.phi,this.theta=t.theta,this}makeSafe(){return this.phi=Ht(this.phi,1e-6,Math.PI-1e-6),this}setFromVector3(t){return this.setFromCartesianCoords(t.x,t.y,t.z)}setFromCartesianCoords(t,e,i){return this.radius=Math.sqrt(t*t+e*e+i*i),this.radius===0?(this.theta=0,this.phi=0):(this.theta=Math.atan2(t,i),this.phi=Math.acos(Ht(e/this.radius,-1,1))),this}clone(){return new this.constructor().copy(this)}};var Sc=class{static{this.prototype.isMatrix2=!0}constructor(t,e,i,s){this.elements=[1,0,0,1],t!==void 0&&this.set(t,e,i,s)}identity(){return this.set(1,0,0,1),this}fromArray(t,e=0){for(let i=0;i<4;i++)this.elements[i]=t[i+e];return this}set(t,e,i,s){let r=this.elements;return r[0]=t,r[2]=e,r[1]=i,r[3]=s,this}};var Rr=class extends Si{constructor(t,e=null){super(),this.object=t,this.domElement=e,this.enabled=!0,this.state=-1,this.keys={},this.mouseButtons={LEFT:null,MIDDLE:null,RIGHT:null},this.touches={ONE:null,TWO:null}}connect(t){this.domElement!==null&&this.disconnect(),this.domElement=t}disconnect(){}dispose(){}update(){}};function sh(n,t,e,i){let s=wg(i);switch(e){case Vc:return n*t;case ba:return n*t/s.components*s.byteLength;case wa:return n*t/s.components*s.byteLength;case bn:return n*t*2/s.components*s.byteLength;case Ma:return n*t*2/s.components*s.byteLength;case Wc:return n*t*3/s.components*s.byteLength;case Ai:return n*t*4/s.components*s.byteLength;case Sa:return n*t*4/s.components*s.byteLength;case Ir:case Lr:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case Dr:case Nr:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case Ta:case Ra:return Math.max(n,16)*Math.max(t,8)/4;case Ea:case Aa:return Math.max(n,8)*Math.max(t,8)/2;case Ca:case Pa:case La:case Da:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*8;case Ia:case Ur:case Na:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case Ua:return Math.floor((n+3)/4)*Math.floor((t+3)/4)*16;case Oa:return Math.floor((n+4)/5)*Math.floor((t+3)/4)*16;case Fa:return Math.floor((n+4)/5)*Math.floor((t+4)/5)*16;case Ba:return Math.floor((n+5)/6)*Math.floor((t+4)/5)*16;case ka:return Math.floor((n+5)/6)*Math.floor((t+5)/6)*16;case za:return Math.floor((n+7)/8)*Math.floor((t+4)/5)*16;case Ha:return Math.floor((n+7)/8)*Math.floor((t+5)/6)*16;case Ga:return Math.floor((n+7)/8)*Math.floor((t+7)/8)*16;case Va:return Math.floor((n+9)/10)*Math.floor((t+4)/5)*16;case Wa:return Math.floor((n+9)/10)*Math.floor((t+5)/6)*16;case Xa:return Math.floor((n+9)/10)*Math.floor((t+7)/8)*16;case qa:return Math.floor((n+9)/10)*Math.floor((t+9)/10)*16;case $a:return Math.floor((n+11)/12)*Math.floor((t+9)/10)*16;case Ya:return Math.floor((n+11)/12)*Math.floor((t+11)/12)*16;case Za:case Ja:case Ka:return Math.ceil(n/4)*Math.ceil(t/4)*16;case ja:case Qa:return Math.ceil(n/4)*Math.ceil(t/4)*8;case Or:case tl:return Math.ceil(n/4)*Math.ceil(t/4)*16}throw new Error(`Unable to determine texture byte length for ${e} format.`)}function wg(n){switch(n){case ei:case kc:return{byteLength:1,components:1};case Ps:case zc:case Ti:return{byteLength:2,components:1};case ya:case va:return{byteLength:2,components:4};case Ei:case _a:case xi:return{byteLength:4,components:1};case Hc:case Gc:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${n}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?At("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");/**
 * @license
 * Copyright 2010-2026 Three.js Authors
 * SPDX-License-Identifier: MIT
 */function Qd(){let n=null,t=!1,e=null,i=null;function s(r,o){i=n.requestAnimationFrame(s),e(r,o)}return{start:function(){t!==!0&&e!==null&&n!==null&&(i=n.requestAnimationFrame(s),t=!0)},stop:function(){n!==null&&n.cancelAnimationFrame(i),t=!1},setAnimationLoop:function(r){e=r},setContext:function(r){n=r}}}function Sg(n){let t=new WeakMap;function e(a,l){let c=a.array,h=a.usage,u=c.byteLength,d=n.createBuffer();n.bindBuffer(l,d),n.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=n.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=n.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=n.HALF_FLOAT:f=n.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=n.SHORT;else if(c instanceof Uint32Array)f=n.UNSIGNED_INT;else if(c instanceof Int32Array)f=n.INT;else if(c instanceof Int8Array)f=n.BYTE;else if(c instanceof Uint8Array)f=n.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=n.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:d,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:u}}function i(a,l,c){let h=l.array,u=l.updateRanges;if(n.bindBuffer(c,a),u.length===0)n.bufferSubData(c,0,h);else{u.sort((f,p)=>f.start-p.start);let d=0;for(let f=1;f<u.length;f++){let p=u[d],_=u[f];_.start<=p.start+p.count+1?p.count=Math.max(p.count,_.start+_.count-p.start):(++d,u[d]=_)}u.length=d+1;for(let f=0,p=u.length;f<p;f++){let _=u[f];n.bufferSubData(c,_.start*h.BYTES_PER_ELEMENT,h,_.start,_.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),t.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=t.get(a);l&&(n.deleteBuffer(l.buffer),t.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=t.get(a);(!h||h.version<a.version)&&t.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=t.get(a);if(c===void 0)t.set(a,e(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");i(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var Eg=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,Tg=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,Ag=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,Rg=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,Cg=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,Pg=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,Ig=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,Lg=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,Dg=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,Ng=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,Ug=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,Og=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,Fg=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,Bg=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,kg=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,zg=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,Hg=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,Gg=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,Vg=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Wg=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Xg=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,qg=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,$g=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Yg=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Zg=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Jg=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Kg=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,jg=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Qg=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,t0="gl_FragColor = linearToOutputTexel( gl_FragColor );",e0=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,i0=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,n0=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,s0=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,r0=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,o0=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,a0=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,l0=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,c0=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,h0=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,u0=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,d0=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,f0=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,p0=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,m0=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,g0=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,x0=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,_0=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,y0=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,v0=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,b0=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,w0=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,M0=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,S0=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,E0=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,T0=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,A0=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,R0=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,C0=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,P0=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,I0=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,L0=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,D0=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,N0=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,U0=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,O0=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,F0=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,B0=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,k0=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,z0=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,H0=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,G0=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,V0=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,W0=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,X0=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,q0=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,$0=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Y0=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Z0=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,J0=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,K0=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,j0=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Q0=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,tx=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,ex=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,ix=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,nx=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,sx=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,rx=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,ox=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,ax=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,lx=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,cx=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,hx=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,ux=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,dx=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,fx=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,px=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,mx=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,gx=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,xx=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,_x=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,yx=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,vx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,bx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,wx=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,Mx=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,Sx=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,Ex=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Tx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,Ax=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Rx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,Cx=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Px=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,Ix=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,Lx=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,Dx=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,Nx=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,Ux=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,Ox=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,Fx=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,Bx=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,kx=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,zx=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Hx=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Gx=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,Vx=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Wx=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,Xx=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,qx=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,$x=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Yx=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,Zx=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,Jx=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,Kx=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,jx=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,Qx=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,t_=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,e_=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,i_=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,n_=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,Gt={alphahash_fragment:Eg,alphahash_pars_fragment:Tg,alphamap_fragment:Ag,alphamap_pars_fragment:Rg,alphatest_fragment:Cg,alphatest_pars_fragment:Pg,aomap_fragment:Ig,aomap_pars_fragment:Lg,batching_pars_vertex:Dg,batching_vertex:Ng,begin_vertex:Ug,beginnormal_vertex:Og,bsdfs:Fg,iridescence_fragment:Bg,bumpmap_pars_fragment:kg,clipping_planes_fragment:zg,clipping_planes_pars_fragment:Hg,clipping_planes_pars_vertex:Gg,clipping_planes_vertex:Vg,color_fragment:Wg,color_pars_fragment:Xg,color_pars_vertex:qg,color_vertex:$g,common:Yg,defaultnormal_vertex:Zg,displacementmap_pars_vertex:Jg,displacementmap_vertex:Kg,emissivemap_fragment:jg,emissivemap_pars_fragment:Qg,colorspace_fragment:t0,colorspace_pars_fragment:e0,envmap_fragment:i0,envmap_common_pars_fragment:n0,envmap_pars_fragment:s0,envmap_pars_vertex:r0,envmap_physical_pars_fragment:g0,envmap_vertex:o0,fog_vertex:a0,fog_pars_vertex:l0,fog_fragment:c0,fog_pars_fragment:h0,gradientmap_pars_fragment:u0,lightmap_pars_fragment:d0,lights_lambert_fragment:f0,lights_lambert_pars_fragment:p0,lights_pars_begin:m0,lights_toon_fragment:x0,lights_toon_pars_fragment:_0,lights_phong_fragment:y0,lights_phong_pars_fragment:v0,lights_physical_fragment:b0,lights_physical_pars_fragment:w0,lights_fragment_begin:M0,lights_fragment_maps:S0,lights_fragment_end:E0,lightprobes_pars_fragment:T0,logdepthbuf_fragment:A0,logdepthbuf_pars_fragment:R0,logdepthbuf_pars_vertex:C0,logdepthbuf_vertex:P0,map_fragment:I0,map_pars_fragment:L0,map_particle_fragment:D0,map_particle_pars_fragment:N0,metalnessmap_fragment:U0,metalnessmap_pars_fragment:O0,morphinstance_vertex:F0,morphcolor_vertex:B0,morphnormal_vertex:k0,morphtarget_pars_vertex:z0,morphtarget_vertex:H0,normal_fragment_begin:G0,normal_fragment_maps:V0,normal_pars_fragment:W0,normal_pars_vertex:X0,normal_vertex:q0,normalmap_pars_fragment:$0,clearcoat_normal_fragment_begin:Y0,clearcoat_normal_fragment_maps:Z0,clearcoat_pars_fragment:J0,iridescence_pars_fragment:K0,opaque_fragment:j0,packing:Q0,premultiplied_alpha_fragment:tx,project_vertex:ex,dithering_fragment:ix,dithering_pars_fragment:nx,roughnessmap_fragment:sx,roughnessmap_pars_fragment:rx,shadowmap_pars_fragment:ox,shadowmap_pars_vertex:ax,shadowmap_vertex:lx,shadowmask_pars_fragment:cx,skinbase_vertex:hx,skinning_pars_vertex:ux,skinning_vertex:dx,skinnormal_vertex:fx,specularmap_fragment:px,specularmap_pars_fragment:mx,tonemapping_fragment:gx,tonemapping_pars_fragment:xx,transmission_fragment:_x,transmission_pars_fragment:yx,uv_pars_fragment:vx,uv_pars_vertex:bx,uv_vertex:wx,worldpos_vertex:Mx,background_vert:Sx,background_frag:Ex,backgroundCube_vert:Tx,backgroundCube_frag:Ax,cube_vert:Rx,cube_frag:Cx,depth_vert:Px,depth_frag:Ix,distance_vert:Lx,distance_frag:Dx,equirect_vert:Nx,equirect_frag:Ux,linedashed_vert:Ox,linedashed_frag:Fx,meshbasic_vert:Bx,meshbasic_frag:kx,meshlambert_vert:zx,meshlambert_frag:Hx,meshmatcap_vert:Gx,meshmatcap_frag:Vx,meshnormal_vert:Wx,meshnormal_frag:Xx,meshphong_vert:qx,meshphong_frag:$x,meshphysical_vert:Yx,meshphysical_frag:Zx,meshtoon_vert:Jx,meshtoon_frag:Kx,points_vert:jx,points_frag:Qx,shadow_vert:t_,shadow_frag:e_,sprite_vert:i_,sprite_frag:n_},pt={common:{diffuse:{value:new Pt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new Nt},alphaMap:{value:null},alphaMapTransform:{value:new Nt},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new Nt}},envmap:{envMap:{value:null},envMapRotation:{value:new Nt},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new Nt}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new Nt}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new Nt},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new Nt},normalScale:{value:new Lt(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new Nt},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new Nt}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new Nt}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new Nt}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new Pt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new Pt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new Nt},alphaTest:{value:0},uvTransform:{value:new Nt}},sprite:{diffuse:{value:new Pt(16777215)},opacity:{value:1},center:{value:new Lt(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new Nt},alphaMap:{value:null},alphaMapTransform:{value:new Nt},alphaTest:{value:0}}},Oi={basic:{uniforms:qe([pt.common,pt.specularmap,pt.envmap,pt.aomap,pt.lightmap,pt.fog]),vertexShader:Gt.meshbasic_vert,fragmentShader:Gt.meshbasic_frag},lambert:{uniforms:qe([pt.common,pt.specularmap,pt.envmap,pt.aomap,pt.lightmap,pt.emissivemap,pt.bumpmap,pt.normalmap,pt.displacementmap,pt.fog,pt.lights,{emissive:{value:new Pt(0)},envMapIntensity:{value:1}}]),vertexShader:Gt.meshlambert_vert,fragmentShader:Gt.meshlambert_frag},phong:{uniforms:qe([pt.common,pt.specularmap,pt.envmap,pt.aomap,pt.lightmap,pt.emissivemap,pt.bumpmap,pt.normalmap,pt.displacementmap,pt.fog,pt.lights,{emissive:{value:new Pt(0)},specular:{value:new Pt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphong_vert,fragmentShader:Gt.meshphong_frag},standard:{uniforms:qe([pt.common,pt.envmap,pt.aomap,pt.lightmap,pt.emissivemap,pt.bumpmap,pt.normalmap,pt.displacementmap,pt.roughnessmap,pt.metalnessmap,pt.fog,pt.lights,{emissive:{value:new Pt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag},toon:{uniforms:qe([pt.common,pt.aomap,pt.lightmap,pt.emissivemap,pt.bumpmap,pt.normalmap,pt.displacementmap,pt.gradientmap,pt.fog,pt.lights,{emissive:{value:new Pt(0)}}]),vertexShader:Gt.meshtoon_vert,fragmentShader:Gt.meshtoon_frag},matcap:{uniforms:qe([pt.common,pt.bumpmap,pt.normalmap,pt.displacementmap,pt.fog,{matcap:{value:null}}]),vertexShader:Gt.meshmatcap_vert,fragmentShader:Gt.meshmatcap_frag},points:{uniforms:qe([pt.points,pt.fog]),vertexShader:Gt.points_vert,fragmentShader:Gt.points_frag},dashed:{uniforms:qe([pt.common,pt.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:Gt.linedashed_vert,fragmentShader:Gt.linedashed_frag},depth:{uniforms:qe([pt.common,pt.displacementmap]),vertexShader:Gt.depth_vert,fragmentShader:Gt.depth_frag},normal:{uniforms:qe([pt.common,pt.bumpmap,pt.normalmap,pt.displacementmap,{opacity:{value:1}}]),vertexShader:Gt.meshnormal_vert,fragmentShader:Gt.meshnormal_frag},sprite:{uniforms:qe([pt.sprite,pt.fog]),vertexShader:Gt.sprite_vert,fragmentShader:Gt.sprite_frag},background:{uniforms:{uvTransform:{value:new Nt},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:Gt.background_vert,fragmentShader:Gt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new Nt}},vertexShader:Gt.backgroundCube_vert,fragmentShader:Gt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:Gt.cube_vert,fragmentShader:Gt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:Gt.equirect_vert,fragmentShader:Gt.equirect_frag},distance:{uniforms:qe([pt.common,pt.displacementmap,{referencePosition:{value:new N},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:Gt.distance_vert,fragmentShader:Gt.distance_frag},shadow:{uniforms:qe([pt.lights,pt.fog,{color:{value:new Pt(0)},opacity:{value:1}}]),vertexShader:Gt.shadow_vert,fragmentShader:Gt.shadow_frag}};Oi.physical={uniforms:qe([Oi.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new Nt},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new Nt},clearcoatNormalScale:{value:new Lt(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new Nt},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new Nt},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new Nt},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new Nt},sheen:{value:0},sheenColor:{value:new Pt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new Nt},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new Nt},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new Nt},transmissionSamplerSize:{value:new Lt},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new Nt},attenuationDistance:{value:0},attenuationColor:{value:new Pt(0)},specularColor:{value:new Pt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new Nt},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new Nt},anisotropyVector:{value:new Lt},anisotropyMap:{value:null},anisotropyMapTransform:{value:new Nt}}]),vertexShader:Gt.meshphysical_vert,fragmentShader:Gt.meshphysical_frag};var il={r:0,b:0,g:0},s_=new $t,tf=new Nt;tf.set(-1,0,0,0,1,0,0,0,1);function r_(n,t,e,i,s,r){let o=new Pt(0),a=s===!0?0:1,l,c,h=null,u=0,d=null;function f(b){let S=b.isScene===!0?b.background:null;if(S&&S.isTexture){let w=b.backgroundBlurriness>0;S=t.get(S,w)}return S}function p(b){let S=!1,w=f(b);w===null?g(o,a):w&&w.isColor&&(g(w,1),S=!0);let E=n.xr.getEnvironmentBlendMode();E==="additive"?e.buffers.color.setClear(0,0,0,1,r):E==="alpha-blend"&&e.buffers.color.setClear(0,0,0,0,r),(n.autoClear||S)&&(e.buffers.depth.setTest(!0),e.buffers.depth.setMask(!0),e.buffers.color.setMask(!0),n.clear(n.autoClearColor,n.autoClearDepth,n.autoClearStencil))}function _(b,S){let w=f(S);w&&w.isCubeTexture?(c===void 0&&(c=new de(new fn(1,1,1),new Xe({name:"BackgroundCubeMaterial",uniforms:Wn(Oi.backgroundCube.uniforms),vertexShader:Oi.backgroundCube.vertexShader,fragmentShader:Oi.backgroundCube.fragmentShader,side:je,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(E,T,x){this.matrixWorld.copyPosition(x.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),i.update(c)),c.material.uniforms.envMap.value=w,c.material.uniforms.backgroundBlurriness.value=S.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(s_.makeRotationFromEuler(S.backgroundRotation)).transpose(),w.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(tf),c.material.toneMapped=qt.getTransfer(w.colorSpace)!==jt,(h!==w||u!==w.version||d!==n.toneMapping)&&(c.material.needsUpdate=!0,h=w,u=w.version,d=n.toneMapping),c.layers.enableAll(),b.unshift(c,c.geometry,c.material,0,0,null)):w&&w.isTexture&&(l===void 0&&(l=new de(new Fn(2,2),new Xe({name:"BackgroundMaterial",uniforms:Wn(Oi.background.uniforms),vertexShader:Oi.background.vertexShader,fragmentShader:Oi.background.fragmentShader,side:vn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),i.update(l)),l.material.uniforms.t2D.value=w,l.material.uniforms.backgroundIntensity.value=S.backgroundIntensity,l.material.toneMapped=qt.getTransfer(w.colorSpace)!==jt,w.matrixAutoUpdate===!0&&w.updateMatrix(),l.material.uniforms.uvTransform.value.copy(w.matrix),(h!==w||u!==w.version||d!==n.toneMapping)&&(l.material.needsUpdate=!0,h=w,u=w.version,d=n.toneMapping),l.layers.enableAll(),b.unshift(l,l.geometry,l.material,0,0,null))}function g(b,S){b.getRGB(il,eh(n)),e.buffers.color.setClear(il.r,il.g,il.b,S,r)}function m(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(b,S=1){o.set(b),a=S,g(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(b){a=b,g(o,a)},render:p,addToRenderList:_,dispose:m}}function o_(n,t){let e=n.getParameter(n.MAX_VERTEX_ATTRIBS),i={},s=d(null),r=s,o=!1;function a(U,F,W,I,H){let $=!1,G=u(U,I,W,F);r!==G&&(r=G,c(r.object)),$=f(U,I,W,H),$&&p(U,I,W,H),H!==null&&t.update(H,n.ELEMENT_ARRAY_BUFFER),($||o)&&(o=!1,w(U,F,W,I),H!==null&&n.bindBuffer(n.ELEMENT_ARRAY_BUFFER,t.get(H).buffer))}function l(){return n.createVertexArray()}function c(U){return n.bindVertexArray(U)}function h(U){return n.deleteVertexArray(U)}function u(U,F,W,I){let H=I.wireframe===!0,$=i[F.id];$===void 0&&($={},i[F.id]=$);let G=U.isInstancedMesh===!0?U.id:0,et=$[G];et===void 0&&(et={},$[G]=et);let X=et[W.id];X===void 0&&(X={},et[W.id]=X);let Q=X[H];return Q===void 0&&(Q=d(l()),X[H]=Q),Q}function d(U){let F=[],W=[],I=[];for(let H=0;H<e;H++)F[H]=0,W[H]=0,I[H]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:F,enabledAttributes:W,attributeDivisors:I,object:U,attributes:{},index:null}}function f(U,F,W,I){let H=r.attributes,$=F.attributes,G=0,et=W.getAttributes();for(let X in et)if(et[X].location>=0){let tt=H[X],wt=$[X];if(wt===void 0&&(X==="instanceMatrix"&&U.instanceMatrix&&(wt=U.instanceMatrix),X==="instanceColor"&&U.instanceColor&&(wt=U.instanceColor)),tt===void 0||tt.attribute!==wt||wt&&tt.data!==wt.data)return!0;G++}return r.attributesNum!==G||r.index!==I}function p(U,F,W,I){let H={},$=F.attributes,G=0,et=W.getAttributes();for(let X in et)if(et[X].location>=0){let tt=$[X];tt===void 0&&(X==="instanceMatrix"&&U.instanceMatrix&&(tt=U.instanceMatrix),X==="instanceColor"&&U.instanceColor&&(tt=U.instanceColor));let wt={};wt.attribute=tt,tt&&tt.data&&(wt.data=tt.data),H[X]=wt,G++}r.attributes=H,r.attributesNum=G,r.index=I}function _(){let U=r.newAttributes;for(let F=0,W=U.length;F<W;F++)U[F]=0}function g(U){m(U,0)}function m(U,F){let W=r.newAttributes,I=r.enabledAttributes,H=r.attributeDivisors;W[U]=1,I[U]===0&&(n.enableVertexAttribArray(U),I[U]=1),H[U]!==F&&(n.vertexAttribDivisor(U,F),H[U]=F)}function b(){let U=r.newAttributes,F=r.enabledAttributes;for(let W=0,I=F.length;W<I;W++)F[W]!==U[W]&&(n.disableVertexAttribArray(W),F[W]=0)}function S(U,F,W,I,H,$,G){G===!0?n.vertexAttribIPointer(U,F,W,H,$):n.vertexAttribPointer(U,F,W,I,H,$)}function w(U,F,W,I){_();let H=I.attributes,$=W.getAttributes(),G=F.defaultAttributeValues;for(let et in $){let X=$[et];if(X.location>=0){let Q=H[et];if(Q===void 0&&(et==="instanceMatrix"&&U.instanceMatrix&&(Q=U.instanceMatrix),et==="instanceColor"&&U.instanceColor&&(Q=U.instanceColor)),Q!==void 0){let tt=Q.normalized,wt=Q.itemSize,Ot=t.get(Q);if(Ot===void 0)continue;let J=Ot.buffer,mt=Ot.type,yt=Ot.bytesPerElement,Rt=mt===n.INT||mt===n.UNSIGNED_INT||Q.gpuType===_a;if(Q.isInterleavedBufferAttribute){let gt=Q.data,Bt=gt.isInterleavedBuffer===!0?gt.stride:gt.itemSize,ve=Q.offset;if(gt.isInstancedInterleavedBuffer||gt.isInstancedBufferAttribute){for(let It=0;It<X.locationSize;It++)m(X.location+It,gt.meshPerAttribute);U.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=gt.meshPerAttribute*gt.count)}else for(let It=0;It<X.locationSize;It++)g(X.location+It);n.bindBuffer(n.ARRAY_BUFFER,J);for(let It=0;It<X.locationSize;It++)S(X.location+It,wt/X.locationSize,mt,tt,Bt*yt,(ve+wt/X.locationSize*It)*yt,Rt)}else{if(Q.isInstancedBufferAttribute){for(let gt=0;gt<X.locationSize;gt++)m(X.location+gt,Q.meshPerAttribute);U.isInstancedMesh!==!0&&I._maxInstanceCount===void 0&&(I._maxInstanceCount=Q.meshPerAttribute*Q.count)}else for(let gt=0;gt<X.locationSize;gt++)g(X.location+gt);n.bindBuffer(n.ARRAY_BUFFER,J);for(let gt=0;gt<X.locationSize;gt++)S(X.location+gt,wt/X.locationSize,mt,tt,wt*yt,wt/X.locationSize*gt*yt,Rt)}}else if(G!==void 0){let tt=G[et];if(tt!==void 0)switch(tt.length){case 2:n.vertexAttrib2fv(X.location,tt);break;case 3:n.vertexAttrib3fv(X.location,tt);break;case 4:n.vertexAttrib4fv(X.location,tt);break;default:n.vertexAttrib1fv(X.location,tt)}}}}b()}function E(){D();for(let U in i){let F=i[U];for(let W in F){let I=F[W];for(let H in I){let $=I[H];for(let G in $)h($[G].object),delete $[G];delete I[H]}}delete i[U]}}function T(U){if(i[U.id]===void 0)return;let F=i[U.id];for(let W in F){let I=F[W];for(let H in I){let $=I[H];for(let G in $)h($[G].object),delete $[G];delete I[H]}}delete i[U.id]}function x(U){for(let F in i){let W=i[F];for(let I in W){let H=W[I];if(H[U.id]===void 0)continue;let $=H[U.id];for(let G in $)h($[G].object),delete $[G];delete H[U.id]}}}function M(U){for(let F in i){let W=i[F],I=U.isInstancedMesh===!0?U.id:0,H=W[I];if(H!==void 0){for(let $ in H){let G=H[$];for(let et in G)h(G[et].object),delete G[et];delete H[$]}delete W[I],Object.keys(W).length===0&&delete i[F]}}}function D(){P(),o=!0,r!==s&&(r=s,c(r.object))}function P(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:D,resetDefaultState:P,dispose:E,releaseStatesOfGeometry:T,releaseStatesOfObject:M,releaseStatesOfProgram:x,initAttributes:_,enableAttribute:g,disableUnusedAttributes:b}}function a_(n,t,e){let i;function s(l){i=l}function r(l,c){n.drawArrays(i,l,c),e.update(c,i,1)}function o(l,c,h){h!==0&&(n.drawArraysInstanced(i,l,c,h),e.update(c,i,h))}function a(l,c,h){if(h===0)return;t.get("WEBGL_multi_draw").multiDrawArraysWEBGL(i,l,0,c,0,h);let d=0;for(let f=0;f<h;f++)d+=c[f];e.update(d,i,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function l_(n,t,e,i){let s;function r(){if(s!==void 0)return s;if(t.has("EXT_texture_filter_anisotropic")===!0){let x=t.get("EXT_texture_filter_anisotropic");s=n.getParameter(x.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(x){return!(x!==Ai&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(x){let M=x===Ti&&(t.has("EXT_color_buffer_half_float")||t.has("EXT_color_buffer_float"));return!(x!==ei&&x!==xi&&!M&&i.convert(x)!==n.getParameter(n.IMPLEMENTATION_COLOR_READ_TYPE))}function l(x){if(x==="highp"){if(n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.HIGH_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.HIGH_FLOAT).precision>0)return"highp";x="mediump"}return x==="mediump"&&n.getShaderPrecisionFormat(n.VERTEX_SHADER,n.MEDIUM_FLOAT).precision>0&&n.getShaderPrecisionFormat(n.FRAGMENT_SHADER,n.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=e.precision!==void 0?e.precision:"highp",h=l(c);h!==c&&(At("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let u=e.reversedDepthBuffer===!0&&t.has("EXT_clip_control"),d=e.logarithmicDepthBuffer===!0&&u===!1;e.reversedDepthBuffer===!0&&u===!1&&At("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),e.logarithmicDepthBuffer===!0&&u===!0&&At("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=n.getParameter(n.MAX_TEXTURE_IMAGE_UNITS),p=n.getParameter(n.MAX_VERTEX_TEXTURE_IMAGE_UNITS),_=n.getParameter(n.MAX_TEXTURE_SIZE),g=n.getParameter(n.MAX_CUBE_MAP_TEXTURE_SIZE),m=n.getParameter(n.MAX_VERTEX_ATTRIBS),b=n.getParameter(n.MAX_VERTEX_UNIFORM_VECTORS),S=n.getParameter(n.MAX_VARYING_VECTORS),w=n.getParameter(n.MAX_FRAGMENT_UNIFORM_VECTORS),E=n.getParameter(n.MAX_SAMPLES),T=n.getParameter(n.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:d,reversedDepthBuffer:u,maxTextures:f,maxVertexTextures:p,maxTextureSize:_,maxCubemapSize:g,maxAttributes:m,maxVertexUniforms:b,maxVaryings:S,maxFragmentUniforms:w,maxSamples:E,samples:T}}function c_(n){let t=this,e=null,i=0,s=!1,r=!1,o=new ai,a=new Nt,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(u,d){let f=u.length!==0||d||i!==0||s;return s=d,i=u.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(u,d){e=h(u,d,0)},this.setState=function(u,d,f){let p=u.clippingPlanes,_=u.clipIntersection,g=u.clipShadows,m=n.get(u);if(!s||p===null||p.length===0||r&&!g)r?h(null):c();else{let b=r?0:i,S=b*4,w=m.clippingState||null;l.value=w,w=h(p,d,S,f);for(let E=0;E!==S;++E)w[E]=e[E];m.clippingState=w,this.numIntersection=_?this.numPlanes:0,this.numPlanes+=b}};function c(){l.value!==e&&(l.value=e,l.needsUpdate=i>0),t.numPlanes=i,t.numIntersection=0}function h(u,d,f,p){let _=u!==null?u.length:0,g=null;if(_!==0){if(g=l.value,p!==!0||g===null){let m=f+_*4,b=d.matrixWorldInverse;a.getNormalMatrix(b),(g===null||g.length<m)&&(g=new Float32Array(m));for(let S=0,w=f;S!==_;++S,w+=4)o.copy(u[S]).applyMatrix4(b,a),o.normal.toArray(g,w),g[w+3]=o.constant}l.value=g,l.needsUpdate=!0}return t.numPlanes=_,t.numIntersection=0,g}}var kr=class extends Ke{constructor(t=1,e={}){super(t,t,e),this.isWebGLCubeRenderTarget=!0;let i={width:t,height:t,depth:1},s=[i,i,i,i,i,i];this.texture=new _r(s),this._setTextureOptions(e),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(t,e){this.texture.type=e.type,this.texture.colorSpace=e.colorSpace,this.texture.generateMipmaps=e.generateMipmaps,this.texture.minFilter=e.minFilter,this.texture.magFilter=e.magFilter;let i={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new fn(5,5,5),r=new Xe({name:"CubemapFromEquirect",uniforms:Wn(i.uniforms),vertexShader:i.vertexShader,fragmentShader:i.fragmentShader,side:je,blending:zn});r.uniforms.tEquirect.value=e;let o=new de(s,r),a=e.minFilter;return e.minFilter===Ji&&(e.minFilter=Ze),new Es(1,10,this).update(t,o),e.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(t,e=!0,i=!0,s=!0){let r=t.getRenderTarget();for(let o=0;o<6;o++)t.setRenderTarget(this,o),t.clear(e,i,s);t.setRenderTarget(r)}},Ld=256,h_=3,u_=20,ef=256,nf=16,d_=3,f_=new N,p_=new Pt,sl=class n{constructor(t){this._renderer=t,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new Es(1,10,null),this._boxMesh=new de(new fn(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(t,e=0,i=.1,s=100,r={}){let{size:o=256,position:a=f_}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);e>0&&(h.texture.mipmapsAutoUpdate=!1);let u=l.autoClear,d=l.autoClearColor,f=l.autoClearDepth,p=l.autoClearStencil,_=t.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,_===null&&(t.background=l.getClearColor(p_));let g=new Es(i,s,h);return g.position.copy(a),g.update(l,t),l.autoClear=u,l.autoClearColor=d,l.autoClearDepth=f,l.autoClearStencil=p,t.background=_,e>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,e)),this._applyPMREM(c),c}fromEquirectangular(t,e=null){return this._fromTexture(t,e)}fromCubemap(t,e=null){return this._fromTexture(t,e)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=Ud(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=Nd(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(t,e){return e>0?1-Math.sqrt(1-t/e):0}_setSize(t){this._cubeSize=Math.max(Ld,Kc(t))}_fromTexture(t,e){t.mapping===Gn||t.mapping===Cs?this._setSize(t.image.length===0?Ld:t.image[0].width||t.image[0].image.width):this._setSize(t.image.width/4);let i=e||this._allocateTarget();return this._textureToCubemap(t),this._applyPMREM(i),i}_allocateTarget(){let t=this._cubeSize,e=Dd(t,!1,!1),i=Math.log2(t)-h_;for(let s=0;s<=i;s++)e.texture.mipmaps.push({width:t>>s,height:t>>s});return e.texture.name="PMREM",e.texture.isPMREMTexture=!0,e}_getSourceTarget(t=!1){let e=this._cubeSize,i=this._sourceTarget;return(i===null||i.width!==e||t&&i.depthBuffer===!1)&&(i!==null&&i.dispose(),this._sourceTarget=Dd(e,!0,t)),this._sourceTarget}_compileMaterial(t){this._boxMesh.material=t,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(t,e,i){let s=this._boxMesh,r=this._cubeCamera;s.material=i,r.renderTarget=t,r.activeMipmapLevel=e;let o=t.width>>e;t.viewport.set(0,0,o,o),r.update(this._renderer,s),t.viewport.set(0,0,t.width,t.height)}_textureToCubemap(t){let e;t.mapping===Gn||t.mapping===Cs?(this._cubemapMaterial===null&&(this._cubemapMaterial=Ud()),e=this._cubemapMaterial,e.uniforms.flipEnvMap.value=t.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=Nd()),e=this._equirectMaterial),e.uniforms.envMap.value=t,this._renderCube(this._getSourceTarget(),0,e)}_applyPMREM(t){this._ggxMaterial===null&&(this._ggxMaterial=m_(),this._integrationMaterial=g_());let e=this._cubeSize,i=t.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(e/nf);for(let o=0;o<=i;o++){let a=n.lodToRoughness(o,i);if(o>i-d_)r.roughness.value=a,this._renderCube(t,o,this._integrationMaterial);else{let l=a>0?Math.log2(e)+.5*Math.log2(6/(ef*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(t,o,this._ggxMaterial)}}}_blur(t,e){this._blurMaterial===null&&(this._blurMaterial=x_());let i=this._blurMaterial,s=i.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(e,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(t,0,i),s.envMap.value=t.texture,this._renderCube(r,0,i)}};function Dd(n,t,e){return new kr(n,{minFilter:Ji,generateMipmaps:t,type:Ti,colorSpace:lr,depthBuffer:e})}function zr(n,t,e){return new Xe({name:n,uniforms:t,vertexShader:Gt.cube_vert,fragmentShader:e,side:je,blending:zn,depthTest:!1,depthWrite:!1})}function m_(){return zr("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${ef}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function g_(){return zr("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:nf}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function x_(){return zr("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${u_}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function Nd(){return zr("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function Ud(){return zr("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function __(n){let t=new WeakMap,e=new WeakMap,i=null;function s(d,f=!1){return d==null?null:f?o(d):r(d)}function r(d){if(d&&d.isTexture){let f=d.mapping;if(f===ma||f===ga)if(t.has(d)){let p=t.get(d).texture;return a(p,d.mapping)}else{let p=d.image;if(p&&p.height>0){let _=new kr(p.height);return _.fromEquirectangularTexture(n,d),t.set(d,_),d.addEventListener("dispose",c),a(_.texture,d.mapping)}else return null}}return d}function o(d){if(d&&d.isTexture&&d.isPMREMTexture!==!0){let f=d.mapping,p=f===ma||f===ga,_=f===Gn||f===Cs;if(p||_){let g=e.get(d),m=g!==void 0?g.texture.pmremVersion:0;if(d.isRenderTargetTexture&&d.pmremVersion!==m)return i===null&&(i=new sl(n)),g=p?i.fromEquirectangular(d,g):i.fromCubemap(d,g),g.texture.pmremVersion=d.pmremVersion,e.set(d,g),g.texture;if(g!==void 0)return g.texture;{let b=d.image;return p&&b&&b.height>0||_&&b&&l(b)?(i===null&&(i=new sl(n)),g=p?i.fromEquirectangular(d):i.fromCubemap(d),g.texture.pmremVersion=d.pmremVersion,e.set(d,g),d.addEventListener("dispose",h),g.texture):null}}}return d}function a(d,f){return f===ma?d.mapping=Gn:f===ga&&(d.mapping=Cs),d}function l(d){let f=0,p=6;for(let _=0;_<p;_++)d[_]!==void 0&&f++;return f===p}function c(d){let f=d.target;f.removeEventListener("dispose",c);let p=t.get(f);p!==void 0&&(t.delete(f),p.dispose())}function h(d){let f=d.target;f.removeEventListener("dispose",h);let p=e.get(f);p!==void 0&&(e.delete(f),p.dispose())}function u(){t=new WeakMap,e=new WeakMap,i!==null&&(i.dispose(),i=null)}return{get:s,dispose:u}}function y_(n){let t={};function e(i){if(t[i]!==void 0)return t[i];let s=n.getExtension(i);return t[i]=s,s}return{has:function(i){return e(i)!==null},init:function(){e("EXT_color_buffer_float"),e("WEBGL_clip_cull_distance"),e("OES_texture_float_linear"),e("EXT_color_buffer_half_float"),e("WEBGL_multisampled_render_to_texture"),e("WEBGL_render_shared_exponent")},get:function(i){let s=e(i);return s===null&&sr("WebGLRenderer: "+i+" extension not supported."),s}}}function v_(n,t,e,i){let s={},r=new WeakMap,o=new FinalizationRegistry(p=>delete s[p]);function a(p){l(p.target)}function l(p){p.index!==null&&t.remove(p.index);for(let g in p.attributes)t.remove(p.attributes[g]);p.removeEventListener("dispose",a),delete s[p.id],o.unregister(p);let _=r.get(p);_&&(t.remove(_),r.delete(p)),i.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,e.memory.geometries--}function c(p,_){return s[_.id]!==void 0||(_.addEventListener("dispose",a),s[_.id]=new WeakRef(_),o.register(_,_.id,_),e.memory.geometries++),_}function h(p){let _=p.attributes;for(let g in _)t.update(_[g],n.ARRAY_BUFFER)}function u(p){let _=p.index,g=p.attributes.position,m=0;if(g===void 0)return;let b=_!==null?_.array.length:g.array.length/3-1,S=g.count>=65535?mr:pr,w=new S(Math.ceil(b/3)*6,1),E=w.array;if(_!==null){let x=_.array;m=_.version;for(let M=0,D=0;M<b;M+=3){let P=x[M+0],U=x[M+1],F=x[M+2];E[D++]=P,E[D++]=U,E[D++]=U,E[D++]=F,E[D++]=F,E[D++]=P}}else{m=g.version;for(let x=0,M=0;x<b;x+=3){let D=x+0,P=x+1,U=x+2;E[M++]=D,E[M++]=P,E[M++]=P,E[M++]=U,E[M++]=U,E[M++]=D}}w.version=m;let T=r.get(p);T&&t.remove(T),r.set(p,w)}function d(p){let _=r.get(p);if(_){let g=p.index;g!==null&&_.version<g.version&&u(p)}else u(p);return r.get(p)}function f(){for(let p in s){let _=s[p].deref();_!==void 0&&l(_)}}return{get:c,update:h,getWireframeAttribute:d,dispose:f}}function b_(n,t,e){let i;function s(u){i=u}let r,o;function a(u){r=u.type,o=u.bytesPerElement}function l(u,d){n.drawElements(i,d,r,u*o),e.update(d,i,1)}function c(u,d,f){f!==0&&(n.drawElementsInstanced(i,d,r,u*o,f),e.update(d,i,f))}function h(u,d,f){if(f===0)return;t.get("WEBGL_multi_draw").multiDrawElementsWEBGL(i,d,0,r,u,0,f);let _=0;for(let g=0;g<f;g++)_+=d[g];e.update(_,i,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function w_(n){let t={geometries:0,textures:0},e={frame:0,calls:0,triangles:0,points:0,lines:0};function i(r,o,a){switch(e.calls++,o){case n.TRIANGLES:e.triangles+=a*(r/3);break;case n.LINES:e.lines+=a*(r/2);break;case n.LINE_STRIP:e.lines+=a*(r-1);break;case n.LINE_LOOP:e.lines+=a*r;break;case n.POINTS:e.points+=a*r;break;default:Dt("WebGLInfo: Unknown draw mode:",o);break}}function s(){e.calls=0,e.triangles=0,e.points=0,e.lines=0}return{memory:t,render:e,programs:null,autoReset:!0,reset:s,update:i}}function M_(n,t,e){let i=new WeakMap,s=new he;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,u=h!==void 0?h.length:0,d=i.get(a);if(d===void 0||d.count!==u){let D=function(){x.dispose(),i.delete(a),a.removeEventListener("dispose",D)};d!==void 0&&d.texture.dispose();let f=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,_=a.morphAttributes.color!==void 0,g=a.morphAttributes.position||[],m=a.morphAttributes.normal||[],b=a.morphAttributes.color||[],S=0;f===!0&&(S=1),p===!0&&(S=2),_===!0&&(S=3);let w=a.attributes.position.count*S,E=1;w>t.maxTextureSize&&(E=Math.ceil(w/t.maxTextureSize),w=t.maxTextureSize);let T=new Float32Array(w*E*4*u),x=new ur(T,w,E,u);x.type=xi,x.needsUpdate=!0;let M=S*4;for(let P=0;P<u;P++){let U=g[P],F=m[P],W=b[P],I=w*E*4*P;for(let H=0;H<U.count;H++){let $=H*M;f===!0&&(s.fromBufferAttribute(U,H),T[I+$+0]=s.x,T[I+$+1]=s.y,T[I+$+2]=s.z,T[I+$+3]=0),p===!0&&(s.fromBufferAttribute(F,H),T[I+$+4]=s.x,T[I+$+5]=s.y,T[I+$+6]=s.z,T[I+$+7]=0),_===!0&&(s.fromBufferAttribute(W,H),T[I+$+8]=s.x,T[I+$+9]=s.y,T[I+$+10]=s.z,T[I+$+11]=W.itemSize===4?s.w:1)}}d={count:u,texture:x,size:new Lt(w,E)},i.set(a,d),a.addEventListener("dispose",D)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(n,"morphTexture",o.morphTexture,e);else{let f=0;for(let _=0;_<c.length;_++)f+=c[_];let p=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(n,"morphTargetBaseInfluence",p),l.getUniforms().setValue(n,"morphTargetInfluences",c)}l.getUniforms().setValue(n,"morphTargetsTexture",d.texture,e),l.getUniforms().setValue(n,"morphTargetsTextureSize",d.size)}return{update:r}}function S_(n,t,e,i,s){let r=new WeakMap;function o(c){let h=s.render.frame,u=c.geometry,d=t.get(c,u);if(r.get(d)!==h&&(t.update(d),r.set(d,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(e.update(c.instanceMatrix,n.ARRAY_BUFFER),c.instanceColor!==null&&e.update(c.instanceColor,n.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return d}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),i.releaseStatesOfObject(h),e.remove(h.instanceMatrix),h.instanceColor!==null&&e.remove(h.instanceColor)}return{update:o,dispose:a}}var E_={[Ic]:"LINEAR_TONE_MAPPING",[Lc]:"REINHARD_TONE_MAPPING",[Dc]:"CINEON_TONE_MAPPING",[Nc]:"ACES_FILMIC_TONE_MAPPING",[Oc]:"AGX_TONE_MAPPING",[Fc]:"NEUTRAL_TONE_MAPPING",[Uc]:"CUSTOM_TONE_MAPPING"};function T_(n,t,e,i,s,r){let o=new Ke(t,e,{type:n,depthBuffer:s,stencilBuffer:r,samples:i?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new ue;h.setAttribute("position",new Jt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new Jt([0,2,0,0,2,0],2));let u=new Qo({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),d=new de(h,u),f=new Tr(-1,1,1,-1,0,1),p=null,_=null,g=!1,m,b=null,S=[],w=!1;this.setSize=function(E,T){o.setSize(E,T),a!==null&&a.setSize(E,T),l!==null&&l.setSize(E,T);for(let x=0;x<S.length;x++){let M=S[x];M.setSize&&M.setSize(E,T)}},this.setEffects=function(E){S=E,w=S.length>0&&S[0].isRenderPass===!0;let T=o.width,x=o.height;S.length>0&&a===null&&(a=new Ke(T,x,{type:Ti,depthBuffer:!1,stencilBuffer:!1}),l=new Ke(T,x,{type:Ti,depthBuffer:!1,stencilBuffer:!1}));let M=s===!0&&S.some(D=>D.needsDepthTexture===!0);M!==(o.depthTexture!==null)&&(M===!0&&c===null&&(c=new Yi(T,x),r===!0&&(c.format=Ki,c.type=Vn)),o.dispose(),o.depthTexture=M?c:null,o.resolveDepthBuffer=M,o.storeMultisampledDepthBuffer=M);for(let D=0;D<S.length;D++){let P=S[D];P.setSize&&P.setSize(T,x),M&&P.needsDepthTexture===!0&&P.setDepthTexture&&P.setDepthTexture(c)}},this.begin=function(E,T){if(g||E.toneMapping===Ni&&S.length===0)return!1;if(b=T,T!==null){let x=T.width,M=T.height;(o.width!==x||o.height!==M)&&this.setSize(x,M)}return w===!1&&E.setRenderTarget(o),m=E.toneMapping,E.toneMapping=Ni,!0},this.hasRenderPass=function(){return w},this.end=function(E,T){E.toneMapping=m,g=!0;let x=o,M=a;for(let D=0;D<S.length;D++){let P=S[D];P.enabled!==!1&&(P.render(E,M,x,T),P.needsSwap!==!1&&(x=M,M=M===a?l:a))}if(p!==E.outputColorSpace||_!==E.toneMapping){p=E.outputColorSpace,_=E.toneMapping,u.defines={},qt.getTransfer(p)===jt&&(u.defines.SRGB_TRANSFER="");let D=E_[_];D&&(u.defines[D]=""),u.needsUpdate=!0}u.uniforms.tDiffuse.value=x.texture,E.setRenderTarget(b),E.render(d,f),b=null,g=!1},this.isCompositing=function(){return g},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),u.dispose()}}var sf=new ti,rf=new Yi(1,1),of=new yr(1),af=new ur,lf=new $o,cf=new _r,Od=[],Fd=[],Bd=new Float32Array(16),kd=new Float32Array(9),zd=new Float32Array(4);function Ds(n,t,e){let i=n[0];if(i<=0||i>0)return n;let s=t*e,r=Od[s];if(r===void 0&&(r=new Float32Array(s),Od[s]=r),t!==0){i.toArray(r,0);for(let o=1,a=0;o!==t;++o)a+=e,n[o].toArray(r,a)}return r}function Te(n,t){if(n.length!==t.length)return!1;for(let e=0,i=n.length;e<i;e++)if(n[e]!==t[e])return!1;return!0}function Ae(n,t){for(let e=0,i=t.length;e<i;e++)n[e]=t[e]}function ol(n,t){let e=Fd[t];e===void 0&&(e=new Int32Array(t),Fd[t]=e);for(let i=0;i!==t;++i)e[i]=n.allocateTextureUnit();return e}function A_(n,t){let e=this.cache;e[0]!==t&&(n.uniform1f(this.addr,t),e[0]=t)}function R_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2f(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Te(e,t))return;n.uniform2fv(this.addr,t),Ae(e,t)}}function C_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3f(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else if(t.r!==void 0)(e[0]!==t.r||e[1]!==t.g||e[2]!==t.b)&&(n.uniform3f(this.addr,t.r,t.g,t.b),e[0]=t.r,e[1]=t.g,e[2]=t.b);else{if(Te(e,t))return;n.uniform3fv(this.addr,t),Ae(e,t)}}function P_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4f(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Te(e,t))return;n.uniform4fv(this.addr,t),Ae(e,t)}}function I_(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Te(e,t))return;n.uniformMatrix2fv(this.addr,!1,t),Ae(e,t)}else{if(Te(e,i))return;zd.set(i),n.uniformMatrix2fv(this.addr,!1,zd),Ae(e,i)}}function L_(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Te(e,t))return;n.uniformMatrix3fv(this.addr,!1,t),Ae(e,t)}else{if(Te(e,i))return;kd.set(i),n.uniformMatrix3fv(this.addr,!1,kd),Ae(e,i)}}function D_(n,t){let e=this.cache,i=t.elements;if(i===void 0){if(Te(e,t))return;n.uniformMatrix4fv(this.addr,!1,t),Ae(e,t)}else{if(Te(e,i))return;Bd.set(i),n.uniformMatrix4fv(this.addr,!1,Bd),Ae(e,i)}}function N_(n,t){let e=this.cache;e[0]!==t&&(n.uniform1i(this.addr,t),e[0]=t)}function U_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2i(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Te(e,t))return;n.uniform2iv(this.addr,t),Ae(e,t)}}function O_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3i(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Te(e,t))return;n.uniform3iv(this.addr,t),Ae(e,t)}}function F_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4i(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Te(e,t))return;n.uniform4iv(this.addr,t),Ae(e,t)}}function B_(n,t){let e=this.cache;e[0]!==t&&(n.uniform1ui(this.addr,t),e[0]=t)}function k_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y)&&(n.uniform2ui(this.addr,t.x,t.y),e[0]=t.x,e[1]=t.y);else{if(Te(e,t))return;n.uniform2uiv(this.addr,t),Ae(e,t)}}function z_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z)&&(n.uniform3ui(this.addr,t.x,t.y,t.z),e[0]=t.x,e[1]=t.y,e[2]=t.z);else{if(Te(e,t))return;n.uniform3uiv(this.addr,t),Ae(e,t)}}function H_(n,t){let e=this.cache;if(t.x!==void 0)(e[0]!==t.x||e[1]!==t.y||e[2]!==t.z||e[3]!==t.w)&&(n.uniform4ui(this.addr,t.x,t.y,t.z,t.w),e[0]=t.x,e[1]=t.y,e[2]=t.z,e[3]=t.w);else{if(Te(e,t))return;n.uniform4uiv(this.addr,t),Ae(e,t)}}function al(n){return n.version===0&&(n.compareFunction=$c,n.needsUpdate=!0),n}function G_(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_2D_SHADOW?r=al(rf):r=sf,e.setTexture2D(t||r,s)}function V_(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture3D(t||lf,s)}function W_(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s);let r;this.type===n.SAMPLER_CUBE_SHADOW?r=al(of):r=cf,e.setTextureCube(t||r,s)}function X_(n,t,e){let i=this.cache,s=e.allocateTextureUnit();i[0]!==s&&(n.uniform1i(this.addr,s),i[0]=s),e.setTexture2DArray(t||af,s)}function q_(n){switch(n){case 5126:return A_;case 35664:return R_;case 35665:return C_;case 35666:return P_;case 35674:return I_;case 35675:return L_;case 35676:return D_;case 5124:case 35670:return N_;case 35667:case 35671:return U_;case 35668:case 35672:return O_;case 35669:case 35673:return F_;case 5125:return B_;case 36294:return k_;case 36295:return z_;case 36296:return H_;case 35678:case 36198:case 36298:case 36306:case 35682:return G_;case 35679:case 36299:case 36307:return V_;case 35680:case 36300:case 36308:case 36293:return W_;case 36289:case 36303:case 36311:case 36292:return X_}}function $_(n,t){n.uniform1fv(this.addr,t)}function Y_(n,t){let e=Ds(t,this.size,2);n.uniform2fv(this.addr,e)}function Z_(n,t){let e=Ds(t,this.size,3);n.uniform3fv(this.addr,e)}function J_(n,t){let e=Ds(t,this.size,4);n.uniform4fv(this.addr,e)}function K_(n,t){let e=Ds(t,this.size,4);n.uniformMatrix2fv(this.addr,!1,e)}function j_(n,t){let e=Ds(t,this.size,9);n.uniformMatrix3fv(this.addr,!1,e)}function Q_(n,t){let e=Ds(t,this.size,16);n.uniformMatrix4fv(this.addr,!1,e)}function ty(n,t){n.uniform1iv(this.addr,t)}function ey(n,t){n.uniform2iv(this.addr,t)}function iy(n,t){n.uniform3iv(this.addr,t)}function ny(n,t){n.uniform4iv(this.addr,t)}function sy(n,t){n.uniform1uiv(this.addr,t)}function ry(n,t){n.uniform2uiv(this.addr,t)}function oy(n,t){n.uniform3uiv(this.addr,t)}function ay(n,t){n.uniform4uiv(this.addr,t)}function ly(n,t,e){let i=this.cache,s=t.length,r=ol(e,s);Te(i,r)||(n.uniform1iv(this.addr,r),Ae(i,r));let o;this.type===n.SAMPLER_2D_SHADOW?o=al(rf):o=sf;for(let a=0;a!==s;++a)e.setTexture2D(t[a]||o,r[a])}function cy(n,t,e){let i=this.cache,s=t.length,r=ol(e,s);Te(i,r)||(n.uniform1iv(this.addr,r),Ae(i,r));for(let o=0;o!==s;++o)e.setTexture3D(t[o]||lf,r[o])}function hy(n,t,e){let i=this.cache,s=t.length,r=ol(e,s);Te(i,r)||(n.uniform1iv(this.addr,r),Ae(i,r));let o;this.type===n.SAMPLER_CUBE_SHADOW?o=al(of):o=cf;for(let a=0;a!==s;++a)e.setTextureCube(t[a]||o,r[a])}function uy(n,t,e){let i=this.cache,s=t.length,r=ol(e,s);Te(i,r)||(n.uniform1iv(this.addr,r),Ae(i,r));for(let o=0;o!==s;++o)e.setTexture2DArray(t[o]||af,r[o])}function dy(n){switch(n){case 5126:return $_;case 35664:return Y_;case 35665:return Z_;case 35666:return J_;case 35674:return K_;case 35675:return j_;case 35676:return Q_;case 5124:case 35670:return ty;case 35667:case 35671:return ey;case 35668:case 35672:return iy;case 35669:case 35673:return ny;case 5125:return sy;case 36294:return ry;case 36295:return oy;case 36296:return ay;case 35678:case 36198:case 36298:case 36306:case 35682:return ly;case 35679:case 36299:case 36307:return cy;case 35680:case 36300:case 36308:case 36293:return hy;case 36289:case 36303:case 36311:case 36292:return uy}}var ah=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.setValue=q_(e.type)}},lh=class{constructor(t,e,i){this.id=t,this.addr=i,this.cache=[],this.type=e.type,this.size=e.size,this.setValue=dy(e.type)}},ch=class{constructor(t){this.id=t,this.seq=[],this.map={}}setValue(t,e,i){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(t,e[a.id],i)}}},rh=/(\w+)(\])?(\[|\.)?/g;function Hd(n,t){n.seq.push(t),n.map[t.id]=t}function fy(n,t,e){let i=n.name,s=i.length;for(rh.lastIndex=0;;){let r=rh.exec(i),o=rh.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){Hd(e,c===void 0?new ah(a,n,t):new lh(a,n,t));break}else{let u=e.map[a];u===void 0&&(u=new ch(a),Hd(e,u)),e=u}}}var Ls=class{constructor(t,e){this.seq=[],this.map={};let i=t.getProgramParameter(e,t.ACTIVE_UNIFORMS);for(let o=0;o<i;++o){let a=t.getActiveUniform(e,o),l=t.getUniformLocation(e,a.name);fy(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===t.SAMPLER_2D_SHADOW||o.type===t.SAMPLER_CUBE_SHADOW||o.type===t.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(t,e,i,s){let r=this.map[e];r!==void 0&&r.setValue(t,i,s)}setOptional(t,e,i){let s=e[i];s!==void 0&&this.setValue(t,i,s)}static upload(t,e,i,s){for(let r=0,o=e.length;r!==o;++r){let a=e[r],l=i[a.id];l.needsUpdate!==!1&&a.setValue(t,l.value,s)}}static seqWithValue(t,e){let i=[];for(let s=0,r=t.length;s!==r;++s){let o=t[s];o.id in e&&i.push(o)}return i}};function Gd(n,t,e){let i=n.createShader(t);return n.shaderSource(i,e),n.compileShader(i),i}var py=37297,my=0;function gy(n,t){let e=n.split(`
`),i=[],s=Math.max(t-6,0),r=Math.min(t+6,e.length);for(let o=s;o<r;o++){let a=o+1;i.push(`${a===t?">":" "} ${a}: ${e[o]}`)}return i.join(`
`)}var Vd=new Nt;function xy(n){qt._getMatrix(Vd,qt.workingColorSpace,n);let t=`mat3( ${Vd.elements.map(e=>e.toFixed(4))} )`;switch(qt.getTransfer(n)){case cr:return[t,"LinearTransferOETF"];case jt:return[t,"sRGBTransferOETF"];default:return At("WebGLProgram: Unsupported color space: ",n),[t,"LinearTransferOETF"]}}function Wd(n,t,e){let i=n.getShaderParameter(t,n.COMPILE_STATUS),r=(n.getShaderInfoLog(t)||"").trim();if(i&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return e.toUpperCase()+`

`+r+`

`+gy(n.getShaderSource(t),a)}else return r}function _y(n,t){let e=xy(t);return[`vec4 ${n}( vec4 value ) {`,`	return ${e[1]}( vec4( ${e[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var yy={[Ic]:"Linear",[Lc]:"Reinhard",[Dc]:"Cineon",[Nc]:"ACESFilmic",[Oc]:"AgX",[Fc]:"Neutral",[Uc]:"Custom"};function vy(n,t){let e=yy[t];return e===void 0?(At("WebGLProgram: Unsupported toneMapping:",t),"vec3 "+n+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+n+"( vec3 color ) { return "+e+"ToneMapping( color ); }"}var nl=new N;function by(){qt.getLuminanceCoefficients(nl);let n=nl.x.toFixed(4),t=nl.y.toFixed(4),e=nl.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${n}, ${t}, ${e} );`,"	return dot( weights, rgb );","}"].join(`
`)}function wy(n){return[n.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",n.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Br).join(`
`)}function My(n){let t=[];for(let e in n){let i=n[e];i!==!1&&t.push("#define "+e+" "+i)}return t.join(`
`)}function Sy(n,t){let e={},i=n.getProgramParameter(t,n.ACTIVE_ATTRIBUTES);for(let s=0;s<i;s++){let r=n.getActiveAttrib(t,s),o=r.name,a=1;r.type===n.FLOAT_MAT2&&(a=2),r.type===n.FLOAT_MAT3&&(a=3),r.type===n.FLOAT_MAT4&&(a=4),e[o]={type:r.type,location:n.getAttribLocation(t,o),locationSize:a}}return e}function Br(n){return n!==""}function Xd(n,t){let e=t.numSpotLightShadows+t.numSpotLightMaps-t.numSpotLightShadowsWithMaps;return n.replace(/NUM_SUN_LIGHTS/g,t.numSunLights).replace(/NUM_DIR_LIGHTS/g,t.numDirLights).replace(/NUM_SPOT_LIGHTS/g,t.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,t.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,e).replace(/NUM_RECT_AREA_LIGHTS/g,t.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,t.numPointLights).replace(/NUM_HEMI_LIGHTS/g,t.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,t.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,t.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,t.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,t.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,t.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,t.numLightProbeGrids)}function qd(n,t){return n.replace(/NUM_CLIPPING_PLANES/g,t.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,t.numClippingPlanes-t.numClipIntersection)}var Ey=/^[ \t]*#include +<([\w\d./]+)>/gm;function hh(n){return n.replace(Ey,Ty)}function Ty(n,t){let e=Gt[t];if(e===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+t+">");return hh(e)}var Ay=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function $d(n){return n.replace(Ay,Ry)}function Ry(n,t,e,i){let s="";for(let r=parseInt(t);r<parseInt(e);r++)s+=i.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function Yd(n){let t=`precision ${n.precision} float;
	precision ${n.precision} int;
	precision ${n.precision} sampler2D;
	precision ${n.precision} samplerCube;
	precision ${n.precision} sampler3D;
	precision ${n.precision} sampler2DArray;
	precision ${n.precision} sampler2DShadow;
	precision ${n.precision} samplerCubeShadow;
	precision ${n.precision} sampler2DArrayShadow;
	precision ${n.precision} isampler2D;
	precision ${n.precision} isampler3D;
	precision ${n.precision} isamplerCube;
	precision ${n.precision} isampler2DArray;
	precision ${n.precision} usampler2D;
	precision ${n.precision} usampler3D;
	precision ${n.precision} usamplerCube;
	precision ${n.precision} usampler2DArray;
	`;return n.precision==="highp"?t+=`
#define HIGH_PRECISION`:n.precision==="mediump"?t+=`
#define MEDIUM_PRECISION`:n.precision==="lowp"&&(t+=`
#define LOW_PRECISION`),t}var Cy={[Cr]:"SHADOWMAP_TYPE_PCF",[As]:"SHADOWMAP_TYPE_VSM"};function Py(n){return Cy[n.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var Iy={[Cs]:"ENVMAP_MODE_REFRACTION"};function Ly(n){return n.envMap===!1?"ENVMAP_MODE_REFLECTION":Iy[n.envMapMode]||"ENVMAP_MODE_REFLECTION"}var Dy={[pa]:"ENVMAP_BLENDING_MULTIPLY",[hd]:"ENVMAP_BLENDING_MIX",[ud]:"ENVMAP_BLENDING_ADD"};function Ny(n){return n.envMap===!1?"ENVMAP_BLENDING_NONE":Dy[n.combine]||"ENVMAP_BLENDING_NONE"}function Uy(n,t,e,i){let s=n.getContext(),r=e.defines,o=e.vertexShader,a=e.fragmentShader,l=Py(e),c=e.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=Ly(e),u=Ny(e),d=wy(e),f=My(r),p=s.createProgram(),_,g,m=e.glslVersion?"#version "+e.glslVersion+`
`:"";e.isRawShaderMaterial?(_=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(Br).join(`
`),_.length>0&&(_+=`
`),g=["#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f].filter(Br).join(`
`),g.length>0&&(g+=`
`)):(_=[Yd(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",e.batching?"#define USE_BATCHING":"",e.batchingColor?"#define USE_BATCHING_COLOR":"",e.instancing?"#define USE_INSTANCING":"",e.instancingColor?"#define USE_INSTANCING_COLOR":"",e.instancingMorph?"#define USE_INSTANCING_MORPH":"",e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.map?"#define USE_MAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+h:"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.displacementMap?"#define USE_DISPLACEMENTMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.mapUv?"#define MAP_UV "+e.mapUv:"",e.alphaMapUv?"#define ALPHAMAP_UV "+e.alphaMapUv:"",e.lightMapUv?"#define LIGHTMAP_UV "+e.lightMapUv:"",e.aoMapUv?"#define AOMAP_UV "+e.aoMapUv:"",e.emissiveMapUv?"#define EMISSIVEMAP_UV "+e.emissiveMapUv:"",e.bumpMapUv?"#define BUMPMAP_UV "+e.bumpMapUv:"",e.normalMapUv?"#define NORMALMAP_UV "+e.normalMapUv:"",e.displacementMapUv?"#define DISPLACEMENTMAP_UV "+e.displacementMapUv:"",e.metalnessMapUv?"#define METALNESSMAP_UV "+e.metalnessMapUv:"",e.roughnessMapUv?"#define ROUGHNESSMAP_UV "+e.roughnessMapUv:"",e.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+e.anisotropyMapUv:"",e.clearcoatMapUv?"#define CLEARCOATMAP_UV "+e.clearcoatMapUv:"",e.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+e.clearcoatNormalMapUv:"",e.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+e.clearcoatRoughnessMapUv:"",e.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+e.diffuseRoughnessMapUv:"",e.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+e.iridescenceMapUv:"",e.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+e.iridescenceThicknessMapUv:"",e.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+e.sheenColorMapUv:"",e.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+e.sheenRoughnessMapUv:"",e.specularMapUv?"#define SPECULARMAP_UV "+e.specularMapUv:"",e.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+e.specularColorMapUv:"",e.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+e.specularIntensityMapUv:"",e.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+e.transmissionMapUv:"",e.thicknessMapUv?"#define THICKNESSMAP_UV "+e.thicknessMapUv:"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexNormals?"#define HAS_NORMAL":"",e.vertexColors?"#define USE_COLOR":"",e.vertexAlphas?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.flatShading?"#define FLAT_SHADED":"",e.skinning?"#define USE_SKINNING":"",e.morphTargets?"#define USE_MORPHTARGETS":"",e.morphNormals&&e.flatShading===!1?"#define USE_MORPHNORMALS":"",e.morphColors?"#define USE_MORPHCOLORS":"",e.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+e.morphTextureStride:"",e.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+e.morphTargetsCount:"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.sizeAttenuation?"#define USE_SIZEATTENUATION":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Br).join(`
`),g=[Yd(e),"#define SHADER_TYPE "+e.shaderType,"#define SHADER_NAME "+e.shaderName,f,e.useFog&&e.fog?"#define USE_FOG":"",e.useFog&&e.fogExp2?"#define FOG_EXP2":"",e.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",e.map?"#define USE_MAP":"",e.matcap?"#define USE_MATCAP":"",e.envMap?"#define USE_ENVMAP":"",e.envMap?"#define "+c:"",e.envMap?"#define "+h:"",e.envMap?"#define "+u:"",e.envMapPMREM?"#define ENVMAP_MAX_LOD "+e.envMapMaxLod+".0":"",e.envMapPMREM?"#define ENVMAP_SIZE "+e.envMapSize+".0":"",e.lightMap?"#define USE_LIGHTMAP":"",e.aoMap?"#define USE_AOMAP":"",e.bumpMap?"#define USE_BUMPMAP":"",e.normalMap?"#define USE_NORMALMAP":"",e.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",e.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",e.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",e.emissiveMap?"#define USE_EMISSIVEMAP":"",e.anisotropy?"#define USE_ANISOTROPY":"",e.anisotropyMap?"#define USE_ANISOTROPYMAP":"",e.clearcoat?"#define USE_CLEARCOAT":"",e.clearcoatMap?"#define USE_CLEARCOATMAP":"",e.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",e.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",e.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",e.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",e.dispersion?"#define USE_DISPERSION":"",e.retroreflection?"#define USE_RETROREFLECTION":"",e.iridescence?"#define USE_IRIDESCENCE":"",e.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",e.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",e.specularMap?"#define USE_SPECULARMAP":"",e.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",e.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",e.roughnessMap?"#define USE_ROUGHNESSMAP":"",e.metalnessMap?"#define USE_METALNESSMAP":"",e.alphaMap?"#define USE_ALPHAMAP":"",e.alphaTest?"#define USE_ALPHATEST":"",e.alphaHash?"#define USE_ALPHAHASH":"",e.sheen?"#define USE_SHEEN":"",e.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",e.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",e.transmission?"#define USE_TRANSMISSION":"",e.transmissionMap?"#define USE_TRANSMISSIONMAP":"",e.thicknessMap?"#define USE_THICKNESSMAP":"",e.vertexTangents&&e.flatShading===!1?"#define USE_TANGENT":"",e.vertexColors||e.instancingColor?"#define USE_COLOR":"",e.vertexAlphas||e.batchingColor?"#define USE_COLOR_ALPHA":"",e.vertexUv1s?"#define USE_UV1":"",e.vertexUv2s?"#define USE_UV2":"",e.vertexUv3s?"#define USE_UV3":"",e.pointsUvs?"#define USE_POINTS_UV":"",e.gradientMap?"#define USE_GRADIENTMAP":"",e.flatShading?"#define FLAT_SHADED":"",e.doubleSided?"#define DOUBLE_SIDED":"",e.flipSided?"#define FLIP_SIDED":"",e.shadowMapEnabled?"#define USE_SHADOWMAP":"",e.shadowMapEnabled?"#define "+l:"",e.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",e.numLightProbes>0?"#define USE_LIGHT_PROBES":"",e.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",e.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",e.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",e.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",e.toneMapping!==Ni?"#define TONE_MAPPING":"",e.toneMapping!==Ni?Gt.tonemapping_pars_fragment:"",e.toneMapping!==Ni?vy("toneMapping",e.toneMapping):"",e.dithering?"#define DITHERING":"",e.opaque?"#define OPAQUE":"",Gt.colorspace_pars_fragment,_y("linearToOutputTexel",e.outputColorSpace),by(),e.useDepthPacking?"#define DEPTH_PACKING "+e.depthPacking:"",`
`].filter(Br).join(`
`)),o=hh(o),o=Xd(o,e),o=qd(o,e),a=hh(a),a=Xd(a,e),a=qd(a,e),o=$d(o),a=$d(a),e.isRawShaderMaterial!==!0&&(m=`#version 300 es
`,_=[d,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+_,g=["#define varying in",e.glslVersion===Yc?"":"layout(location = 0) out highp vec4 pc_fragColor;",e.glslVersion===Yc?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+g);let b=m+_+o,S=m+g+a,w=Gd(s,s.VERTEX_SHADER,b),E=Gd(s,s.FRAGMENT_SHADER,S);s.attachShader(p,w),s.attachShader(p,E),e.index0AttributeName!==void 0?s.bindAttribLocation(p,0,e.index0AttributeName):e.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function T(P){if(n.debug.checkShaderErrors){let U=s.getProgramInfoLog(p)||"",F=s.getShaderInfoLog(w)||"",W=s.getShaderInfoLog(E)||"",I=U.trim(),H=F.trim(),$=W.trim(),G=!0,et=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(G=!1,typeof n.debug.onShaderError=="function")n.debug.onShaderError(s,p,w,E);else{let X=Wd(s,w,"vertex"),Q=Wd(s,E,"fragment");Dt("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+P.name+`
Material Type: `+P.type+`

Program Info Log: `+I+`
`+X+`
`+Q)}else I!==""?At("WebGLProgram: Program Info Log:",I):(H===""||$==="")&&(et=!1);et&&(P.diagnostics={runnable:G,programLog:I,vertexShader:{log:H,prefix:_},fragmentShader:{log:$,prefix:g}})}s.deleteShader(w),s.deleteShader(E),x=new Ls(s,p),M=Sy(s,p)}let x;this.getUniforms=function(){return x===void 0&&T(this),x};let M;this.getAttributes=function(){return M===void 0&&T(this),M};let D=e.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return D===!1&&(D=s.getProgramParameter(p,py)),D},this.destroy=function(){i.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=e.shaderType,this.name=e.shaderName,this.id=my++,this.cacheKey=t,this.usedTimes=1,this.program=p,this.vertexShader=w,this.fragmentShader=E,this}var Oy=0,uh=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(t,e,i){let s=this._getShaderCacheForMaterial(t);return s.has(e)===!1&&(s.add(e),e.usedTimes++),s.has(i)===!1&&(s.add(i),i.usedTimes++),this}remove(t){let e=this.materialCache.get(t);for(let i of e)i.usedTimes--,i.usedTimes===0&&this.shaderCache.delete(i.code);return this.materialCache.delete(t),this}getVertexShaderStage(t){return this._getShaderStage(t.vertexShader)}getFragmentShaderStage(t){return this._getShaderStage(t.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(t){let e=this.materialCache,i=e.get(t);return i===void 0&&(i=new Set,e.set(t,i)),i}_getShaderStage(t){let e=this.shaderCache,i=e.get(t);return i===void 0&&(i=new dh(t),e.set(t,i)),i}},dh=class{constructor(t){this.id=Oy++,this.code=t,this.usedTimes=0}};function Fy(n){return n===bn||n===Ur||n===Or}function By(n,t,e,i,s,r){let o=new dr,a=new uh,l=new Set,c=[],h=new Map,u=i.logarithmicDepthBuffer,d={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(x){return l.add(x),x===0?"uv":`uv${x}`}function p(x,M,D,P,U,F){let W=P.fog,I=U.geometry,H=x.isMeshStandardMaterial||x.isMeshLambertMaterial||x.isMeshPhongMaterial?P.environment:null,$=x.isMeshStandardMaterial||x.isMeshLambertMaterial&&!x.envMap||x.isMeshPhongMaterial&&!x.envMap,G=t.get(x.envMap||H,$),et=d[x.type],X=i.precision;x.precision!==null&&(X=i.getMaxPrecision(x.precision),X!==x.precision&&At("WebGLProgram.getParameters:",x.precision,"not supported, using",X,"instead."));let Q=I.morphAttributes.position||I.morphAttributes.normal||I.morphAttributes.color,tt=Q!==void 0?Q.length:0,wt=0;I.morphAttributes.position!==void 0&&(wt=1),I.morphAttributes.normal!==void 0&&(wt=2),I.morphAttributes.color!==void 0&&(wt=3);let Ot,J,mt,yt;if(et){let ft=Oi[et];Ot=ft.vertexShader,J=ft.fragmentShader}else{Ot=x.vertexShader,J=x.fragmentShader;let ft=a.getVertexShaderStage(x),te=a.getFragmentShaderStage(x);a.update(x,ft,te),mt=ft.id,yt=te.id}let Rt=n.getRenderTarget(),gt=n.state.buffers.depth.getReversed(),Bt=U.isInstancedMesh===!0,ve=U.isBatchedMesh===!0,It=!!x.map,Qt=!!x.matcap,ee=!!G,Vt=ee&&G.isPMREMTexture===!0,Oe=!!x.aoMap,Se=!!x.lightMap,Qe=!!x.bumpMap&&x.wireframe===!1,fe=!!x.normalMap,Ci=!!x.displacementMap,Ce=!!x.emissiveMap,hi=!!x.metalnessMap,ui=!!x.roughnessMap,di=x.anisotropy>0,O=x.clearcoat>0,fi=x.diffuseRoughness>0,le=x.dispersion>0,ce=x.retroreflectivity>0,dt=x.iridescence>0,Ee=x.sheen>0,Ct=x.transmission>0,Ut=di&&!!x.anisotropyMap,A=O&&!!x.clearcoatMap,y=O&&!!x.clearcoatNormalMap,k=O&&!!x.clearcoatRoughnessMap,it=fi&&!!x.diffuseRoughnessMap,j=dt&&!!x.iridescenceMap,rt=dt&&!!x.iridescenceThicknessMap,ht=Ee&&!!x.sheenColorMap,Y=Ee&&!!x.sheenRoughnessMap,Z=!!x.specularMap,at=!!x.specularColorMap,C=!!x.specularIntensityMap,K=Ct&&!!x.transmissionMap,q=Ct&&!!x.thicknessMap,lt=!!x.gradientMap,st=!!x.alphaMap,ot=x.alphaTest>0,St=!!x.alphaHash,zt=!!x.extensions,nt=Ni;x.toneMapped&&(Rt===null||Rt.isXRRenderTarget===!0)&&(nt=n.toneMapping);let Tt=Vt?G.isCompressedCubeTexture?G.image[0].mipmaps:G.mipmaps:null,kt={shaderID:et,shaderType:x.type,shaderName:x.name,vertexShader:Ot,fragmentShader:J,defines:x.defines,customVertexShaderID:mt,customFragmentShaderID:yt,isRawShaderMaterial:x.isRawShaderMaterial===!0,glslVersion:x.glslVersion,precision:X,batching:ve,batchingColor:ve&&U._colorsTexture!==null,instancing:Bt,instancingColor:Bt&&U.instanceColor!==null,instancingMorph:Bt&&U.morphTexture!==null,outputColorSpace:Rt===null?n.outputColorSpace:Rt.isXRRenderTarget===!0?Rt.texture.colorSpace:qt.workingColorSpace,alphaToCoverage:!!x.alphaToCoverage,map:It,matcap:Qt,envMap:ee,envMapMode:ee&&G.mapping,envMapPMREM:Vt,envMapMaxLod:Vt?Tt.length-1:null,envMapSize:Vt?Tt[0].width:null,aoMap:Oe,lightMap:Se,bumpMap:Qe,normalMap:fe,displacementMap:Ci,emissiveMap:Ce,normalMapObjectSpace:fe&&x.normalMapType===pd,normalMapTangentSpace:fe&&x.normalMapType===el,packedNormalMap:fe&&x.normalMapType===el&&Fy(x.normalMap.format),metalnessMap:hi,roughnessMap:ui,anisotropy:di,anisotropyMap:Ut,clearcoat:O,clearcoatMap:A,clearcoatNormalMap:y,clearcoatRoughnessMap:k,diffuseRoughness:fi,diffuseRoughnessMap:it,dispersion:le,retroreflection:ce,iridescence:dt,iridescenceMap:j,iridescenceThicknessMap:rt,sheen:Ee,sheenColorMap:ht,sheenRoughnessMap:Y,specularMap:Z,specularColorMap:at,specularIntensityMap:C,transmission:Ct,transmissionMap:K,thicknessMap:q,gradientMap:lt,opaque:x.transparent===!1&&x.blending===Rs&&x.alphaToCoverage===!1,alphaMap:st,alphaTest:ot,alphaHash:St,combine:x.combine,mapUv:It&&f(x.map.channel),aoMapUv:Oe&&f(x.aoMap.channel),lightMapUv:Se&&f(x.lightMap.channel),bumpMapUv:Qe&&f(x.bumpMap.channel),normalMapUv:fe&&f(x.normalMap.channel),displacementMapUv:Ci&&f(x.displacementMap.channel),emissiveMapUv:Ce&&f(x.emissiveMap.channel),metalnessMapUv:hi&&f(x.metalnessMap.channel),roughnessMapUv:ui&&f(x.roughnessMap.channel),anisotropyMapUv:Ut&&f(x.anisotropyMap.channel),clearcoatMapUv:A&&f(x.clearcoatMap.channel),clearcoatNormalMapUv:y&&f(x.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:k&&f(x.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:it&&f(x.diffuseRoughnessMap.channel),iridescenceMapUv:j&&f(x.iridescenceMap.channel),iridescenceThicknessMapUv:rt&&f(x.iridescenceThicknessMap.channel),sheenColorMapUv:ht&&f(x.sheenColorMap.channel),sheenRoughnessMapUv:Y&&f(x.sheenRoughnessMap.channel),specularMapUv:Z&&f(x.specularMap.channel),specularColorMapUv:at&&f(x.specularColorMap.channel),specularIntensityMapUv:C&&f(x.specularIntensityMap.channel),transmissionMapUv:K&&f(x.transmissionMap.channel),thicknessMapUv:q&&f(x.thicknessMap.channel),alphaMapUv:st&&f(x.alphaMap.channel),vertexTangents:!!I.attributes.tangent&&(fe||di),vertexNormals:!!I.attributes.normal,vertexColors:x.vertexColors,vertexAlphas:x.vertexColors===!0&&!!I.attributes.color&&I.attributes.color.itemSize===4,pointsUvs:U.isPoints===!0&&!!I.attributes.uv&&(It||st),fog:!!W,useFog:x.fog===!0,fogExp2:!!W&&W.isFogExp2,flatShading:x.wireframe===!1&&(x.flatShading===!0||I.attributes.normal===void 0&&fe===!1&&(x.isMeshLambertMaterial||x.isMeshPhongMaterial||x.isMeshStandardMaterial||x.isMeshPhysicalMaterial)),sizeAttenuation:x.sizeAttenuation===!0,logarithmicDepthBuffer:u,reversedDepthBuffer:gt,skinning:U.isSkinnedMesh===!0,hasPositionAttribute:I.attributes.position!==void 0,morphTargets:I.morphAttributes.position!==void 0,morphNormals:I.morphAttributes.normal!==void 0,morphColors:I.morphAttributes.color!==void 0,morphTargetsCount:tt,morphTextureStride:wt,numSunLights:M.sun.length,numDirLights:M.directional.length,numPointLights:M.point.length,numSpotLights:M.spot.length,numSpotLightMaps:M.spotLightMap.length,numRectAreaLights:M.rectArea.length,numHemiLights:M.hemi.length,numSunLightShadows:M.sunShadowMap.length,numDirLightShadows:M.directionalShadowMap.length,numPointLightShadows:M.pointShadowMap.length,numSpotLightShadows:M.spotShadowMap.length,numSpotLightShadowsWithMaps:M.numSpotLightShadowsWithMaps,numLightProbes:M.numLightProbes,numLightProbeGrids:F.filter(ft=>ft.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:x.dithering,shadowMapEnabled:n.shadowMap.enabled&&D.length>0,shadowMapType:n.shadowMap.type,toneMapping:nt,decodeVideoTexture:It&&x.map.isVideoTexture===!0&&qt.getTransfer(x.map.colorSpace)===jt,decodeVideoTextureEmissive:Ce&&x.emissiveMap.isVideoTexture===!0&&qt.getTransfer(x.emissiveMap.colorSpace)===jt,premultipliedAlpha:x.premultipliedAlpha,doubleSided:x.side===Me,flipSided:x.side===je,useDepthPacking:x.depthPacking>=0,depthPacking:x.depthPacking||0,index0AttributeName:x.index0AttributeName,extensionClipCullDistance:zt&&x.extensions.clipCullDistance===!0&&e.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(zt&&x.extensions.multiDraw===!0||ve)&&e.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:e.has("KHR_parallel_shader_compile"),customProgramCacheKey:x.customProgramCacheKey()};return kt.vertexUv1s=l.has(1),kt.vertexUv2s=l.has(2),kt.vertexUv3s=l.has(3),l.clear(),kt}function _(x){let M=[];if(x.shaderID?M.push(x.shaderID):(M.push(x.customVertexShaderID),M.push(x.customFragmentShaderID)),x.defines!==void 0)for(let D in x.defines)M.push(D),M.push(x.defines[D]);return x.isRawShaderMaterial===!1&&(g(M,x),m(M,x),M.push(n.outputColorSpace)),M.push(x.customProgramCacheKey),M.join()}function g(x,M){x.push(M.precision),x.push(M.outputColorSpace),x.push(M.envMapMode),x.push(M.envMapPMREM),x.push(M.envMapMaxLod),x.push(M.envMapSize),x.push(M.mapUv),x.push(M.alphaMapUv),x.push(M.lightMapUv),x.push(M.aoMapUv),x.push(M.bumpMapUv),x.push(M.normalMapUv),x.push(M.displacementMapUv),x.push(M.emissiveMapUv),x.push(M.metalnessMapUv),x.push(M.roughnessMapUv),x.push(M.anisotropyMapUv),x.push(M.clearcoatMapUv),x.push(M.clearcoatNormalMapUv),x.push(M.clearcoatRoughnessMapUv),x.push(M.diffuseRoughnessMapUv),x.push(M.iridescenceMapUv),x.push(M.iridescenceThicknessMapUv),x.push(M.sheenColorMapUv),x.push(M.sheenRoughnessMapUv),x.push(M.specularMapUv),x.push(M.specularColorMapUv),x.push(M.specularIntensityMapUv),x.push(M.transmissionMapUv),x.push(M.thicknessMapUv),x.push(M.combine),x.push(M.fogExp2),x.push(M.sizeAttenuation),x.push(M.morphTargetsCount),x.push(M.numSunLights),x.push(M.numDirLights),x.push(M.numPointLights),x.push(M.numSpotLights),x.push(M.numSpotLightMaps),x.push(M.numHemiLights),x.push(M.numRectAreaLights),x.push(M.numSunLightShadows),x.push(M.numDirLightShadows),x.push(M.numPointLightShadows),x.push(M.numSpotLightShadows),x.push(M.numSpotLightShadowsWithMaps),x.push(M.numLightProbes),x.push(M.numLightProbeGrids),x.push(M.shadowMapType),x.push(M.toneMapping),x.push(M.numClippingPlanes),x.push(M.numClipIntersection),x.push(M.depthPacking)}function m(x,M){o.disableAll(),M.instancing&&o.enable(0),M.instancingColor&&o.enable(1),M.instancingMorph&&o.enable(2),M.matcap&&o.enable(3),M.envMap&&o.enable(4),M.normalMapObjectSpace&&o.enable(5),M.normalMapTangentSpace&&o.enable(6),M.clearcoat&&o.enable(7),M.iridescence&&o.enable(8),M.alphaTest&&o.enable(9),M.vertexColors&&o.enable(10),M.vertexAlphas&&o.enable(11),M.vertexUv1s&&o.enable(12),M.vertexUv2s&&o.enable(13),M.vertexUv3s&&o.enable(14),M.vertexTangents&&o.enable(15),M.anisotropy&&o.enable(16),M.alphaHash&&o.enable(17),M.batching&&o.enable(18),M.dispersion&&o.enable(19),M.retroreflection&&o.enable(24),M.diffuseRoughness&&o.enable(25),M.batchingColor&&o.enable(20),M.gradientMap&&o.enable(21),M.packedNormalMap&&o.enable(22),M.vertexNormals&&o.enable(23),x.push(o.mask),o.disableAll(),M.fog&&o.enable(0),M.useFog&&o.enable(1),M.flatShading&&o.enable(2),M.logarithmicDepthBuffer&&o.enable(3),M.reversedDepthBuffer&&o.enable(4),M.skinning&&o.enable(5),M.morphTargets&&o.enable(6),M.morphNormals&&o.enable(7),M.morphColors&&o.enable(8),M.premultipliedAlpha&&o.enable(9),M.shadowMapEnabled&&o.enable(10),M.doubleSided&&o.enable(11),M.flipSided&&o.enable(12),M.useDepthPacking&&o.enable(13),M.dithering&&o.enable(14),M.transmission&&o.enable(15),M.sheen&&o.enable(16),M.opaque&&o.enable(17),M.pointsUvs&&o.enable(18),M.decodeVideoTexture&&o.enable(19),M.decodeVideoTextureEmissive&&o.enable(20),M.alphaToCoverage&&o.enable(21),M.numLightProbeGrids>0&&o.enable(22),M.hasPositionAttribute&&o.enable(23),x.push(o.mask)}function b(x){let M=d[x.type],D;if(M){let P=Oi[M];D=Cd.clone(P.uniforms)}else D=x.uniforms;return D}function S(x,M){let D=h.get(M);return D!==void 0?++D.usedTimes:(D=new Uy(n,M,x,s),c.push(D),h.set(M,D)),D}function w(x){if(--x.usedTimes===0){let M=c.indexOf(x);c[M]=c[c.length-1],c.pop(),h.delete(x.cacheKey),x.destroy()}}function E(x){a.remove(x)}function T(){a.dispose()}return{getParameters:p,getProgramCacheKey:_,getUniforms:b,acquireProgram:S,releaseProgram:w,releaseShaderCache:E,programs:c,dispose:T}}function ky(){let n=new WeakMap;function t(o){return n.has(o)}function e(o){let a=n.get(o);return a===void 0&&(a={},n.set(o,a)),a}function i(o){n.delete(o)}function s(o,a,l){n.get(o)[a]=l}function r(){n=new WeakMap}return{has:t,get:e,remove:i,update:s,dispose:r}}function zy(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.material.id!==t.material.id?n.material.id-t.material.id:n.materialVariant!==t.materialVariant?n.materialVariant-t.materialVariant:n.z!==t.z?n.z-t.z:n.id-t.id}function Zd(n,t){return n.groupOrder!==t.groupOrder?n.groupOrder-t.groupOrder:n.renderOrder!==t.renderOrder?n.renderOrder-t.renderOrder:n.z!==t.z?t.z-n.z:n.id-t.id}function Jd(){let n=[],t=0,e=[],i=[],s=[];function r(){t=0,e.length=0,i.length=0,s.length=0}function o(d){let f=0;return d.isInstancedMesh&&(f+=2),d.isSkinnedMesh&&(f+=1),f}function a(d,f,p,_,g,m){let b=n[t];return b===void 0?(b={id:d.id,object:d,geometry:f,material:p,materialVariant:o(d),groupOrder:_,renderOrder:d.renderOrder,z:g,group:m},n[t]=b):(b.id=d.id,b.object=d,b.geometry=f,b.material=p,b.materialVariant=o(d),b.groupOrder=_,b.renderOrder=d.renderOrder,b.z=g,b.group=m),t++,b}function l(d,f,p,_,g,m,b){b.reversedDepth===!0&&(g=-g);let S=a(d,f,p,_,g,m);p.transmission>0?i.push(S):p.transparent===!0?s.push(S):e.push(S)}function c(d,f,p,_,g,m){let b=a(d,f,p,_,g,m);p.transmission>0?i.unshift(b):p.transparent===!0?s.unshift(b):e.unshift(b)}function h(d,f){e.length>1&&e.sort(d||zy),i.length>1&&i.sort(f||Zd),s.length>1&&s.sort(f||Zd)}function u(){for(let d=t,f=n.length;d<f;d++){let p=n[d];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:e,transmissive:i,transparent:s,init:r,push:l,unshift:c,finish:u,sort:h}}function Hy(){let n=new WeakMap;function t(i,s){let r=n.get(i),o;return r===void 0?(o=new Jd,n.set(i,[o])):s>=r.length?(o=new Jd,r.push(o)):o=r[s],o}function e(){n=new WeakMap}return{get:t,dispose:e}}function Gy(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={direction:new N,color:new Pt};break;case"SpotLight":e={position:new N,direction:new N,color:new Pt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":e={position:new N,color:new Pt,distance:0,decay:0};break;case"HemisphereLight":e={direction:new N,skyColor:new Pt,groundColor:new Pt};break;case"RectAreaLight":e={color:new Pt,position:new N,halfWidth:new N,halfHeight:new N};break}return n[t.id]=e,e}}}function Vy(){let n={};return{get:function(t){if(n[t.id]!==void 0)return n[t.id];let e;switch(t.type){case"SunLight":case"DirectionalLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Lt};break;case"SpotLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Lt};break;case"PointLight":e={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new Lt,shadowCameraNear:1,shadowCameraFar:1e3};break}return n[t.id]=e,e}}}var Wy=0;function Xy(n,t){return(t.castShadow?2:0)-(n.castShadow?2:0)+(t.map?1:0)-(n.map?1:0)}function qy(n){let t=new Gy,e=Vy(),i={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)i.probe.push(new N);let s=new N,r=new $t,o=new $t;function a(c){let h=0,u=0,d=0;for(let F=0;F<9;F++)i.probe[F].set(0,0,0);let f=0,p=0,_=0,g=0,m=0,b=0,S=0,w=0,E=0,T=0,x=0,M=0,D=0,P=0;c.sort(Xy);for(let F=0,W=c.length;F<W;F++){let I=c[F],H=I.color,$=I.intensity,G=I.distance,et=null;if(I.shadow&&I.shadow.map&&(I.shadow.map.texture.format===bn?et=I.shadow.map.texture:et=I.shadow.map.depthTexture||I.shadow.map.texture),I.isAmbientLight)h+=H.r*$,u+=H.g*$,d+=H.b*$;else if(I.isLightProbe){for(let X=0;X<9;X++)i.probe[X].addScaledVector(I.sh.coefficients[X],$);P++}else if(I.isSunLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let Q=I.shadow,tt=e.get(I);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize.copy(Q.mapSize).multiply(Q.getFrameExtents()),i.sunShadow[p]=tt,i.sunShadowMap[p]=et;let wt=Q.getViewportCount();for(let Ot=0;Ot<wt;Ot++)i.sunShadowMatrix[_+Ot]=Q.getMatrix(Ot),i.sunShadowCascade[_+Ot]=Q._cascadeData[Ot];_+=wt,p++}i.sun[f]=X,f++}else if(I.isDirectionalLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),I.castShadow){let Q=I.shadow,tt=e.get(I);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize=Q.mapSize,i.directionalShadow[g]=tt,i.directionalShadowMap[g]=et,i.directionalShadowMatrix[g]=I.shadow.matrix,E++}i.directional[g]=X,g++}else if(I.isSpotLight){let X=t.get(I);X.position.setFromMatrixPosition(I.matrixWorld),X.color.copy(H).multiplyScalar($),X.distance=G,X.coneCos=Math.cos(I.angle),X.penumbraCos=Math.cos(I.angle*(1-I.penumbra)),X.decay=I.decay,i.spot[b]=X;let Q=I.shadow;if(I.map&&(i.spotLightMap[M]=I.map,M++,Q.updateMatrices(I),I.castShadow&&D++),i.spotLightMatrix[b]=Q.matrix,I.castShadow){let tt=e.get(I);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize=Q.mapSize,i.spotShadow[b]=tt,i.spotShadowMap[b]=et,x++}b++}else if(I.isRectAreaLight){let X=t.get(I);X.color.copy(H).multiplyScalar($),X.halfWidth.set(I.width*.5,0,0),X.halfHeight.set(0,I.height*.5,0),i.rectArea[S]=X,S++}else if(I.isPointLight){let X=t.get(I);if(X.color.copy(I.color).multiplyScalar(I.intensity),X.distance=I.distance,X.decay=I.decay,I.castShadow){let Q=I.shadow,tt=e.get(I);tt.shadowIntensity=Q.intensity,tt.shadowBias=Q.bias,tt.shadowNormalBias=Q.normalBias,tt.shadowRadius=Q.radius,tt.shadowMapSize=Q.mapSize,tt.shadowCameraNear=Q.camera.near,tt.shadowCameraFar=Q.camera.far,i.pointShadow[m]=tt,i.pointShadowMap[m]=et,i.pointShadowMatrix[m]=I.shadow.matrix,T++}i.point[m]=X,m++}else if(I.isHemisphereLight){let X=t.get(I);X.skyColor.copy(I.color).multiplyScalar($),X.groundColor.copy(I.groundColor).multiplyScalar($),i.hemi[w]=X,w++}}S>0&&(n.has("OES_texture_float_linear")===!0?(i.rectAreaLTC1=pt.LTC_FLOAT_1,i.rectAreaLTC2=pt.LTC_FLOAT_2):(i.rectAreaLTC1=pt.LTC_HALF_1,i.rectAreaLTC2=pt.LTC_HALF_2)),i.ambient[0]=h,i.ambient[1]=u,i.ambient[2]=d;let U=i.hash;(U.sunLength!==f||U.directionalLength!==g||U.pointLength!==m||U.spotLength!==b||U.rectAreaLength!==S||U.hemiLength!==w||U.numSunShadows!==p||U.numDirectionalShadows!==E||U.numPointShadows!==T||U.numSpotShadows!==x||U.numSpotMaps!==M||U.numLightProbes!==P)&&(i.sun.length=f,i.directional.length=g,i.spot.length=b,i.rectArea.length=S,i.point.length=m,i.hemi.length=w,i.sunShadow.length=p,i.sunShadowMap.length=p,i.sunShadowMatrix.length=_,i.sunShadowCascade.length=_,i.directionalShadow.length=E,i.directionalShadowMap.length=E,i.directionalShadowMatrix.length=E,i.pointShadow.length=T,i.pointShadowMap.length=T,i.pointShadowMatrix.length=T,i.spotShadow.length=x,i.spotShadowMap.length=x,i.spotLightMatrix.length=x+M-D,i.spotLightMap.length=M,i.numSpotLightShadowsWithMaps=D,i.numLightProbes=P,U.sunLength=f,U.directionalLength=g,U.pointLength=m,U.spotLength=b,U.rectAreaLength=S,U.hemiLength=w,U.numSunShadows=p,U.numDirectionalShadows=E,U.numPointShadows=T,U.numSpotShadows=x,U.numSpotMaps=M,U.numLightProbes=P,i.version=Wy++)}function l(c,h){let u=0,d=0,f=0,p=0,_=0,g=0,m=h.matrixWorldInverse;for(let b=0,S=c.length;b<S;b++){let w=c[b];if(w.isSunLight){let E=i.sun[u];E.direction.setFromMatrixPosition(w.matrixWorld),E.direction.transformDirection(m),u++}else if(w.isDirectionalLight){let E=i.directional[d];E.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(m),d++}else if(w.isSpotLight){let E=i.spot[p];E.position.setFromMatrixPosition(w.matrixWorld),E.position.applyMatrix4(m),E.direction.setFromMatrixPosition(w.matrixWorld),s.setFromMatrixPosition(w.target.matrixWorld),E.direction.sub(s),E.direction.transformDirection(m),p++}else if(w.isRectAreaLight){let E=i.rectArea[_];E.position.setFromMatrixPosition(w.matrixWorld),E.position.applyMatrix4(m),o.identity(),r.copy(w.matrixWorld),r.premultiply(m),o.extractRotation(r),E.halfWidth.set(w.width*.5,0,0),E.halfHeight.set(0,w.height*.5,0),E.halfWidth.applyMatrix4(o),E.halfHeight.applyMatrix4(o),_++}else if(w.isPointLight){let E=i.point[f];E.position.setFromMatrixPosition(w.matrixWorld),E.position.applyMatrix4(m),f++}else if(w.isHemisphereLight){let E=i.hemi[g];E.direction.setFromMatrixPosition(w.matrixWorld),E.direction.transformDirection(m),g++}}}return{setup:a,setupView:l,state:i}}function Kd(n){let t=new qy(n),e=[],i=[],s=[];function r(u){h.camera=u,e.length=0,i.length=0,s.length=0}function o(u){u.isLightProbeGrid?s.push(u):e.push(u)}function a(u){i.push(u)}function l(){t.setup(e),s.sort((u,d)=>u.priority-d.priority||u.id-d.id)}function c(u){t.setupView(e,u)}let h={lightsArray:e,shadowsArray:i,lightProbeGridArray:s,camera:null,lights:t,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function $y(n){let t=new WeakMap;function e(s,r=0){let o=t.get(s),a;return o===void 0?(a=new Kd(n),t.set(s,[a])):r>=o.length?(a=new Kd(n),o.push(a)):a=o[r],a}function i(){t=new WeakMap}return{get:e,dispose:i}}var Yy=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,Zy=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,Jy=[new N(1,0,0),new N(-1,0,0),new N(0,1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1)],Ky=[new N(0,-1,0),new N(0,-1,0),new N(0,0,1),new N(0,0,-1),new N(0,-1,0),new N(0,-1,0)],jd=new $t,Fr=new N,oh=new N;function jy(n,t,e){let i=new dn,s=new Lt,r=new Lt,o=new he,a=new ta,l=new ea,c={},h=e.maxTextureSize,u={[vn]:je,[je]:vn,[Me]:Me},d=new Xe({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new Lt},radius:{value:4}},vertexShader:Yy,fragmentShader:Zy}),f=d.clone();f.defines.HORIZONTAL_PASS=1;let p=new ue;p.setAttribute("position",new Ne(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let _=new de(p,d),g=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Cr;let m=this.type;this.render=function(T,x,M){if(g.enabled===!1||g.autoUpdate===!1&&g.needsUpdate===!1||T.length===0)return;this.type===Xu&&(At("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Cr);let D=n.getRenderTarget(),P=n.getActiveCubeFace(),U=n.getActiveMipmapLevel(),F=n.state;F.setBlending(zn),F.buffers.depth.getReversed()===!0?F.buffers.color.setClear(0,0,0,0):F.buffers.color.setClear(1,1,1,1),F.buffers.depth.setTest(!0),F.setScissorTest(!1);let W=m!==this.type;W&&x.traverse(function(I){I.material&&(Array.isArray(I.material)?I.material.forEach(H=>H.needsUpdate=!0):I.material.needsUpdate=!0)});for(let I=0,H=T.length;I<H;I++){let $=T[I],G=$.shadow;if(G===void 0){At("WebGLShadowMap:",$,"has no shadow.");continue}if(G.autoUpdate===!1&&G.needsUpdate===!1)continue;s.copy(G.mapSize);let et=G.getFrameExtents();s.multiply(et),r.copy(G.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/et.x),s.x=r.x*et.x,G.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/et.y),s.y=r.y*et.y,G.mapSize.y=r.y));let X=n.state.buffers.depth.getReversed();if(G.camera._reversedDepth=X,G.map===null||W===!0){if(G.map!==null&&(G.map.depthTexture!==null&&(G.map.depthTexture.dispose(),G.map.depthTexture=null),G.map.dispose()),this.type===As){if($.isPointLight){At("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}G.map=new Ke(s.x,s.y,{format:bn,type:Ti,minFilter:Ze,magFilter:Ze,generateMipmaps:!1}),G.map.texture.name=$.name+".shadowMap",G.map.depthTexture=new Yi(s.x,s.y,xi),G.map.depthTexture.name=$.name+".shadowMapDepth",G.map.depthTexture.format=Wi,G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=Ue,G.map.depthTexture.magFilter=Ue}else $.isPointLight?(G.map=new kr(s.x),G.map.depthTexture=new yr(s.x,Ei)):(G.map=new Ke(s.x,s.y),G.map.depthTexture=new Yi(s.x,s.y,Ei)),G.map.depthTexture.name=$.name+".shadowMap",G.map.depthTexture.format=Wi,this.type===Cr?(G.map.depthTexture.compareFunction=X?qc:Xc,G.map.depthTexture.minFilter=Ze,G.map.depthTexture.magFilter=Ze):(G.map.depthTexture.compareFunction=null,G.map.depthTexture.minFilter=Ue,G.map.depthTexture.magFilter=Ue);G.camera.updateProjectionMatrix()}G.map.isWebGLCubeRenderTarget!==!0&&(G.map.width!==s.x||G.map.height!==s.y)&&G.map.setSize(s.x,s.y);let Q=G.map.isWebGLCubeRenderTarget?6:G.getViewportCount();$.isPointLight!==!0&&G.updateMatrices($,M);let tt=(G.camera.layers.mask&4294967294)!==0?G.camera.layers:M.layers;for(let wt=0;wt<Q;wt++){let Ot=G.getCamera(wt);if($.isPointLight){let J=G.camera,mt=G.matrix,yt=$.distance||J.far;yt!==J.far&&(J.far=yt,J.updateProjectionMatrix()),Fr.setFromMatrixPosition($.matrixWorld),J.position.copy(Fr),oh.copy(J.position),oh.add(Jy[wt]),J.up.copy(Ky[wt]),J.lookAt(oh),J.updateMatrixWorld(),mt.makeTranslation(-Fr.x,-Fr.y,-Fr.z),jd.multiplyMatrices(J.projectionMatrix,J.matrixWorldInverse),G._frustum.setFromProjectionMatrix(jd,J.coordinateSystem,J.reversedDepth)}if(G.map.isWebGLCubeRenderTarget)n.setRenderTarget(G.map,wt),n.clear();else{wt===0&&(n.setRenderTarget(G.map),n.clear());let J=G.getViewport(wt);o.set(r.x*J.x,r.y*J.y,r.x*J.z,r.y*J.w),F.viewport(o)}i=G.getFrustum(wt),w(x,M,Ot,$,tt,this.type)}G.isPointLightShadow!==!0&&this.type===As&&b(G,M),G.needsUpdate=!1}m=this.type,g.needsUpdate=!1,n.setRenderTarget(D,P,U)};function b(T,x){let M=t.update(_);d.defines.VSM_SAMPLES!==T.blurSamples&&(d.defines.VSM_SAMPLES=T.blurSamples,f.defines.VSM_SAMPLES=T.blurSamples,d.needsUpdate=!0,f.needsUpdate=!0),T.mapPass===null?T.mapPass=new Ke(s.x,s.y,{format:bn,type:Ti}):(T.mapPass.width!==T.map.width||T.mapPass.height!==T.map.height)&&T.mapPass.setSize(T.map.width,T.map.height),d.uniforms.shadow_pass.value=T.map.depthTexture,d.uniforms.resolution.value.set(T.map.width,T.map.height),d.uniforms.radius.value=T.radius,n.setRenderTarget(T.mapPass),n.clear(),n.renderBufferDirect(x,null,M,d,_,null),f.uniforms.shadow_pass.value=T.mapPass.texture,f.uniforms.resolution.value.set(T.map.width,T.map.height),f.uniforms.radius.value=T.radius,n.setRenderTarget(T.map),n.clear(),n.renderBufferDirect(x,null,M,f,_,null)}function S(T,x,M,D){let P=null,U=M.isPointLight===!0?T.customDistanceMaterial:T.customDepthMaterial;if(U!==void 0)P=U;else if(P=M.isPointLight===!0?l:a,n.localClippingEnabled&&x.clipShadows===!0&&Array.isArray(x.clippingPlanes)&&x.clippingPlanes.length!==0||x.displacementMap&&x.displacementScale!==0||x.alphaMap&&x.alphaTest>0||x.map&&x.alphaTest>0||x.alphaToCoverage===!0){let F=P.uuid,W=x.uuid,I=c[F];I===void 0&&(I={},c[F]=I);let H=I[W];H===void 0&&(H=P.clone(),I[W]=H,x.addEventListener("dispose",E)),P=H}if(P.visible=x.visible,P.wireframe=x.wireframe,D===As?P.side=x.shadowSide!==null?x.shadowSide:x.side:P.side=x.shadowSide!==null?x.shadowSide:u[x.side],P.alphaMap=x.alphaMap,P.alphaTest=x.alphaToCoverage===!0?.5:x.alphaTest,P.map=x.map,P.clipShadows=x.clipShadows,P.clippingPlanes=x.clippingPlanes,P.clipIntersection=x.clipIntersection,P.displacementMap=x.displacementMap,P.displacementScale=x.displacementScale,P.displacementBias=x.displacementBias,P.wireframeLinewidth=x.wireframeLinewidth,P.linewidth=x.linewidth,M.isPointLight===!0&&P.isMeshDistanceMaterial===!0){let F=n.properties.get(P);F.light=M}return P}function w(T,x,M,D,P,U){if(T.visible===!1)return;if(T.layers.test(P)&&(T.isMesh||T.isLine||T.isPoints)&&(T.castShadow||T.receiveShadow&&U===As)&&(!T.frustumCulled||T.intersectsFrustum(i))){T.modelViewMatrix.multiplyMatrices(M.matrixWorldInverse,T.matrixWorld);let I=t.update(T),H=T.material;if(Array.isArray(H)){let $=I.groups;for(let G=0,et=$.length;G<et;G++){let X=$[G],Q=H[X.materialIndex];if(Q&&Q.visible){let tt=S(T,Q,D,U);T.onBeforeShadow(n,T,x,M,I,tt,X),n.renderBufferDirect(M,null,I,tt,T,X),T.onAfterShadow(n,T,x,M,I,tt,X)}}}else if(H.visible){let $=S(T,H,D,U);T.onBeforeShadow(n,T,x,M,I,$,null),n.renderBufferDirect(M,null,I,$,T,null),T.onAfterShadow(n,T,x,M,I,$,null)}}let W=T.children;for(let I=0,H=W.length;I<H;I++)w(W[I],x,M,D,P,U)}function E(T){T.target.removeEventListener("dispose",E);for(let M in c){let D=c[M],P=T.target.uuid;P in D&&(D[P].dispose(),delete D[P])}}}function Qy(n,t){function e(){let C=!1,K=new he,q=null,lt=new he(0,0,0,0);return{setMask:function(st){q!==st&&!C&&(n.colorMask(st,st,st,st),q=st)},setLocked:function(st){C=st},setClear:function(st,ot,St,zt,nt){nt===!0&&(st*=zt,ot*=zt,St*=zt),K.set(st,ot,St,zt),lt.equals(K)===!1&&(n.clearColor(st,ot,St,zt),lt.copy(K))},reset:function(){C=!1,q=null,lt.set(-1,0,0,0)}}}function i(){let C=!1,K=!1,q=null,lt=null,st=null;return{setReversed:function(ot){if(K!==ot){let St=t.get("EXT_clip_control");ot?St.clipControlEXT(St.LOWER_LEFT_EXT,St.ZERO_TO_ONE_EXT):St.clipControlEXT(St.LOWER_LEFT_EXT,St.NEGATIVE_ONE_TO_ONE_EXT),K=ot;let zt=st;st=null,this.setClear(zt)}},getReversed:function(){return K},setTest:function(ot){ot?gt(n.DEPTH_TEST):Bt(n.DEPTH_TEST)},setMask:function(ot){q!==ot&&!C&&(n.depthMask(ot),q=ot)},setFunc:function(ot){if(K&&(ot=Ed[ot]),lt!==ot){switch(ot){case Uo:n.depthFunc(n.NEVER);break;case Oo:n.depthFunc(n.ALWAYS);break;case Fo:n.depthFunc(n.LESS);break;case xs:n.depthFunc(n.LEQUAL);break;case Bo:n.depthFunc(n.EQUAL);break;case ko:n.depthFunc(n.GEQUAL);break;case zo:n.depthFunc(n.GREATER);break;case Ho:n.depthFunc(n.NOTEQUAL);break;default:n.depthFunc(n.LEQUAL)}lt=ot}},setLocked:function(ot){C=ot},setClear:function(ot){st!==ot&&(st=ot,K&&(ot=1-ot),n.clearDepth(ot))},reset:function(){C=!1,q=null,lt=null,st=null,K=!1}}}function s(){let C=!1,K=null,q=null,lt=null,st=null,ot=null,St=null,zt=null,nt=null;return{setTest:function(Tt){C||(Tt?gt(n.STENCIL_TEST):Bt(n.STENCIL_TEST))},setMask:function(Tt){K!==Tt&&!C&&(n.stencilMask(Tt),K=Tt)},setFunc:function(Tt,kt,ft){(q!==Tt||lt!==kt||st!==ft)&&(n.stencilFunc(Tt,kt,ft),q=Tt,lt=kt,st=ft)},setOp:function(Tt,kt,ft){(ot!==Tt||St!==kt||zt!==ft)&&(n.stencilOp(Tt,kt,ft),ot=Tt,St=kt,zt=ft)},setLocked:function(Tt){C=Tt},setClear:function(Tt){nt!==Tt&&(n.clearStencil(Tt),nt=Tt)},reset:function(){C=!1,K=null,q=null,lt=null,st=null,ot=null,St=null,zt=null,nt=null}}}let r=new e,o=new i,a=new s,l={},c=new WeakMap,h={},u={},d={},f=new WeakMap,p=[],_=null,g=!1,m=null,b=null,S=null,w=null,E=null,T=null,x=null,M=new Pt(0,0,0),D=0,P=!1,U=null,F=null,W=null,I=null,H=null,$=n.getParameter(n.MAX_COMBINED_TEXTURE_IMAGE_UNITS),G=!1,et=0,X=n.getParameter(n.VERSION);X.indexOf("WebGL")!==-1?(et=parseFloat(/^WebGL (\d)/.exec(X)[1]),G=et>=1):X.indexOf("OpenGL ES")!==-1&&(et=parseFloat(/^OpenGL ES (\d)/.exec(X)[1]),G=et>=2);let Q=null,tt={},wt=n.getParameter(n.SCISSOR_BOX),Ot=n.getParameter(n.VIEWPORT),J=new he().fromArray(wt),mt=new he().fromArray(Ot);function yt(C,K,q,lt){let st=new Uint8Array(4),ot=n.createTexture();n.bindTexture(C,ot),n.texParameteri(C,n.TEXTURE_MIN_FILTER,n.NEAREST),n.texParameteri(C,n.TEXTURE_MAG_FILTER,n.NEAREST);for(let St=0;St<q;St++)C===n.TEXTURE_3D||C===n.TEXTURE_2D_ARRAY?n.texImage3D(K,0,n.RGBA,1,1,lt,0,n.RGBA,n.UNSIGNED_BYTE,st):n.texImage2D(K+St,0,n.RGBA,1,1,0,n.RGBA,n.UNSIGNED_BYTE,st);return ot}let Rt={};Rt[n.TEXTURE_2D]=yt(n.TEXTURE_2D,n.TEXTURE_2D,1),Rt[n.TEXTURE_CUBE_MAP]=yt(n.TEXTURE_CUBE_MAP,n.TEXTURE_CUBE_MAP_POSITIVE_X,6),Rt[n.TEXTURE_2D_ARRAY]=yt(n.TEXTURE_2D_ARRAY,n.TEXTURE_2D_ARRAY,1,1),Rt[n.TEXTURE_3D]=yt(n.TEXTURE_3D,n.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),gt(n.DEPTH_TEST),o.setFunc(xs),Qe(!1),fe(Ec),gt(n.CULL_FACE),Oe(zn);function gt(C){h[C]!==!0&&(n.enable(C),h[C]=!0)}function Bt(C){h[C]!==!1&&(n.disable(C),h[C]=!1)}function ve(C,K){return d[C]!==K?(n.bindFramebuffer(C,K),d[C]=K,C===n.DRAW_FRAMEBUFFER&&(d[n.FRAMEBUFFER]=K),C===n.FRAMEBUFFER&&(d[n.DRAW_FRAMEBUFFER]=K),!0):!1}function It(C,K){let q=p,lt=!1;if(C){q=f.get(K),q===void 0&&(q=[],f.set(K,q));let st=C.textures;if(q.length!==st.length||q[0]!==n.COLOR_ATTACHMENT0){for(let ot=0,St=st.length;ot<St;ot++)q[ot]=n.COLOR_ATTACHMENT0+ot;q.length=st.length,lt=!0}}else q[0]!==n.BACK&&(q[0]=n.BACK,lt=!0);lt&&n.drawBuffers(q)}function Qt(C){return _!==C?(n.useProgram(C),_=C,!0):!1}let ee={[Hn]:n.FUNC_ADD,[$u]:n.FUNC_SUBTRACT,[Yu]:n.FUNC_REVERSE_SUBTRACT};ee[Zu]=n.MIN,ee[Ju]=n.MAX;let Vt={[Ku]:n.ZERO,[ju]:n.ONE,[Qu]:n.SRC_COLOR,[Cc]:n.SRC_ALPHA,[rd]:n.SRC_ALPHA_SATURATE,[nd]:n.DST_COLOR,[ed]:n.DST_ALPHA,[td]:n.ONE_MINUS_SRC_COLOR,[Pc]:n.ONE_MINUS_SRC_ALPHA,[sd]:n.ONE_MINUS_DST_COLOR,[id]:n.ONE_MINUS_DST_ALPHA,[od]:n.CONSTANT_COLOR,[ad]:n.ONE_MINUS_CONSTANT_COLOR,[ld]:n.CONSTANT_ALPHA,[cd]:n.ONE_MINUS_CONSTANT_ALPHA};function Oe(C,K,q,lt,st,ot,St,zt,nt,Tt){if(C===zn){g===!0&&(Bt(n.BLEND),g=!1);return}if(g===!1&&(gt(n.BLEND),g=!0),C!==qu){if(C!==m||Tt!==P){if((b!==Hn||E!==Hn)&&(n.blendEquation(n.FUNC_ADD),b=Hn,E=Hn),Tt)switch(C){case Rs:n.blendFuncSeparate(n.ONE,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Tc:n.blendFunc(n.ONE,n.ONE);break;case Ac:n.blendFuncSeparate(n.ZERO,n.ONE_MINUS_SRC_COLOR,n.ZERO,n.ONE);break;case Rc:n.blendFuncSeparate(n.DST_COLOR,n.ONE_MINUS_SRC_ALPHA,n.ZERO,n.ONE);break;default:Dt("WebGLState: Invalid blending: ",C);break}else switch(C){case Rs:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE_MINUS_SRC_ALPHA,n.ONE,n.ONE_MINUS_SRC_ALPHA);break;case Tc:n.blendFuncSeparate(n.SRC_ALPHA,n.ONE,n.ONE,n.ONE);break;case Ac:Dt("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case Rc:Dt("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:Dt("WebGLState: Invalid blending: ",C);break}S=null,w=null,T=null,x=null,M.set(0,0,0),D=0,m=C,P=Tt}return}st=st||K,ot=ot||q,St=St||lt,(K!==b||st!==E)&&(n.blendEquationSeparate(ee[K],ee[st]),b=K,E=st),(q!==S||lt!==w||ot!==T||St!==x)&&(n.blendFuncSeparate(Vt[q],Vt[lt],Vt[ot],Vt[St]),S=q,w=lt,T=ot,x=St),(zt.equals(M)===!1||nt!==D)&&(n.blendColor(zt.r,zt.g,zt.b,nt),M.copy(zt),D=nt),m=C,P=!1}function Se(C,K){C.side===Me?Bt(n.CULL_FACE):gt(n.CULL_FACE);let q=C.side===je;K&&(q=!q),Qe(q),C.blending===Rs&&C.transparent===!1?Oe(zn):Oe(C.blending,C.blendEquation,C.blendSrc,C.blendDst,C.blendEquationAlpha,C.blendSrcAlpha,C.blendDstAlpha,C.blendColor,C.blendAlpha,C.premultipliedAlpha),o.setFunc(C.depthFunc),o.setTest(C.depthTest),o.setMask(C.depthWrite),r.setMask(C.colorWrite);let lt=C.stencilWrite;a.setTest(lt),lt&&(a.setMask(C.stencilWriteMask),a.setFunc(C.stencilFunc,C.stencilRef,C.stencilFuncMask),a.setOp(C.stencilFail,C.stencilZFail,C.stencilZPass)),Ce(C.polygonOffset,C.polygonOffsetFactor,C.polygonOffsetUnits),C.alphaToCoverage===!0?gt(n.SAMPLE_ALPHA_TO_COVERAGE):Bt(n.SAMPLE_ALPHA_TO_COVERAGE)}function Qe(C){U!==C&&(C?n.frontFace(n.CW):n.frontFace(n.CCW),U=C)}function fe(C){C!==Vu?(gt(n.CULL_FACE),C!==F&&(C===Ec?n.cullFace(n.BACK):C===Wu?n.cullFace(n.FRONT):n.cullFace(n.FRONT_AND_BACK))):Bt(n.CULL_FACE),F=C}function Ci(C){C!==W&&(G&&n.lineWidth(C),W=C)}function Ce(C,K,q){C?(gt(n.POLYGON_OFFSET_FILL),(I!==K||H!==q)&&(I=K,H=q,o.getReversed()&&(K=-K,q=-q),n.polygonOffset(K,q))):Bt(n.POLYGON_OFFSET_FILL)}function hi(C){C?gt(n.SCISSOR_TEST):Bt(n.SCISSOR_TEST)}function ui(C){C===void 0&&(C=n.TEXTURE0+$-1),Q!==C&&(n.activeTexture(C),Q=C)}function di(C,K,q){q===void 0&&(Q===null?q=n.TEXTURE0+$-1:q=Q);let lt=tt[q];lt===void 0&&(lt={type:void 0,texture:void 0},tt[q]=lt),(lt.type!==C||lt.texture!==K)&&(Q!==q&&(n.activeTexture(q),Q=q),n.bindTexture(C,K||Rt[C]),lt.type=C,lt.texture=K)}function O(){let C=tt[Q];C!==void 0&&C.type!==void 0&&(n.bindTexture(C.type,null),C.type=void 0,C.texture=void 0)}function fi(){try{n.compressedTexImage2D(...arguments)}catch(C){Dt("WebGLState:",C)}}function le(){try{n.compressedTexImage3D(...arguments)}catch(C){Dt("WebGLState:",C)}}function ce(){try{n.texSubImage2D(...arguments)}catch(C){Dt("WebGLState:",C)}}function dt(){try{n.texSubImage3D(...arguments)}catch(C){Dt("WebGLState:",C)}}function Ee(){try{n.compressedTexSubImage2D(...arguments)}catch(C){Dt("WebGLState:",C)}}function Ct(){try{n.compressedTexSubImage3D(...arguments)}catch(C){Dt("WebGLState:",C)}}function Ut(){try{n.texStorage2D(...arguments)}catch(C){Dt("WebGLState:",C)}}function A(){try{n.texStorage3D(...arguments)}catch(C){Dt("WebGLState:",C)}}function y(){try{n.texImage2D(...arguments)}catch(C){Dt("WebGLState:",C)}}function k(){try{n.texImage3D(...arguments)}catch(C){Dt("WebGLState:",C)}}function it(C){return u[C]!==void 0?u[C]:n.getParameter(C)}function j(C,K){u[C]!==K&&(n.pixelStorei(C,K),u[C]=K)}function rt(C){J.equals(C)===!1&&(n.scissor(C.x,C.y,C.z,C.w),J.copy(C))}function ht(C){mt.equals(C)===!1&&(n.viewport(C.x,C.y,C.z,C.w),mt.copy(C))}function Y(C,K){let q=c.get(K);q===void 0&&(q=new WeakMap,c.set(K,q));let lt=q.get(C);lt===void 0&&(lt=n.getUniformBlockIndex(K,C.name),n.uniformBlockBinding(K,lt,lt),q.set(C,lt))}function Z(C,K,q){let st=c.get(K).get(C);l[st]!==q&&(n.bindBufferBase(n.UNIFORM_BUFFER,st,q),l[st]=q)}function at(){n.disable(n.BLEND),n.disable(n.CULL_FACE),n.disable(n.DEPTH_TEST),n.disable(n.POLYGON_OFFSET_FILL),n.disable(n.SCISSOR_TEST),n.disable(n.STENCIL_TEST),n.disable(n.SAMPLE_ALPHA_TO_COVERAGE),n.blendEquation(n.FUNC_ADD),n.blendFunc(n.ONE,n.ZERO),n.blendFuncSeparate(n.ONE,n.ZERO,n.ONE,n.ZERO),n.blendColor(0,0,0,0),n.colorMask(!0,!0,!0,!0),n.clearColor(0,0,0,0),n.depthMask(!0),n.depthFunc(n.LESS),o.setReversed(!1),n.clearDepth(1),n.stencilMask(4294967295),n.stencilFunc(n.ALWAYS,0,4294967295),n.stencilOp(n.KEEP,n.KEEP,n.KEEP),n.clearStencil(0),n.cullFace(n.BACK),n.frontFace(n.CCW),n.polygonOffset(0,0),n.activeTexture(n.TEXTURE0),n.bindFramebuffer(n.FRAMEBUFFER,null),n.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),n.bindFramebuffer(n.READ_FRAMEBUFFER,null),n.useProgram(null),n.lineWidth(1),n.scissor(0,0,n.canvas.width,n.canvas.height),n.viewport(0,0,n.canvas.width,n.canvas.height),n.pixelStorei(n.PACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_ALIGNMENT,4),n.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,!1),n.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),n.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,n.BROWSER_DEFAULT_WEBGL),n.pixelStorei(n.PACK_ROW_LENGTH,0),n.pixelStorei(n.PACK_SKIP_PIXELS,0),n.pixelStorei(n.PACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_ROW_LENGTH,0),n.pixelStorei(n.UNPACK_IMAGE_HEIGHT,0),n.pixelStorei(n.UNPACK_SKIP_PIXELS,0),n.pixelStorei(n.UNPACK_SKIP_ROWS,0),n.pixelStorei(n.UNPACK_SKIP_IMAGES,0),h={},u={},Q=null,tt={},d={},l={},f=new WeakMap,p=[],_=null,g=!1,m=null,b=null,S=null,w=null,E=null,T=null,x=null,M=new Pt(0,0,0),D=0,P=!1,U=null,F=null,W=null,I=null,H=null,J.set(0,0,n.canvas.width,n.canvas.height),mt.set(0,0,n.canvas.width,n.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:gt,disable:Bt,bindFramebuffer:ve,drawBuffers:It,useProgram:Qt,setBlending:Oe,setMaterial:Se,setFlipSided:Qe,setCullFace:fe,setLineWidth:Ci,setPolygonOffset:Ce,setScissorTest:hi,activeTexture:ui,bindTexture:di,unbindTexture:O,compressedTexImage2D:fi,compressedTexImage3D:le,texImage2D:y,texImage3D:k,pixelStorei:j,getParameter:it,updateUBOMapping:Y,uniformBlockBinding:Z,texStorage2D:Ut,texStorage3D:A,texSubImage2D:ce,texSubImage3D:dt,compressedTexSubImage2D:Ee,compressedTexSubImage3D:Ct,scissor:rt,viewport:ht,reset:at}}function tv(n,t,e,i,s,r,o){let a=t.has("WEBGL_multisampled_render_to_texture")?t.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new Lt,h=new WeakMap,u=new Set,d,f=new WeakMap,p=new Set,_=new FinalizationRegistry(A=>p.delete(A)),g=!1;try{g=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function m(A,y){return g?new OffscreenCanvas(A,y):hr("canvas")}function b(A,y,k){let it=1,j=Ut(A);if((j.width>k||j.height>k)&&(it=k/Math.max(j.width,j.height)),it<1)if(typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&A instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&A instanceof ImageBitmap||typeof VideoFrame<"u"&&A instanceof VideoFrame){let rt=Math.floor(it*j.width),ht=Math.floor(it*j.height);d===void 0&&(d=m(rt,ht));let Y=y?m(rt,ht):d;return Y.width=rt,Y.height=ht,Y.getContext("2d").drawImage(A,0,0,rt,ht),At("WebGLRenderer: Texture has been resized from ("+j.width+"x"+j.height+") to ("+rt+"x"+ht+")."),Y}else return"data"in A&&At("WebGLRenderer: Image in DataTexture is too big ("+j.width+"x"+j.height+")."),A;return A}function S(A){return A.generateMipmaps}function w(A){n.generateMipmap(A)}function E(A){return A.isWebGLCubeRenderTarget?n.TEXTURE_CUBE_MAP:A.isWebGL3DRenderTarget?n.TEXTURE_3D:A.isWebGLArrayRenderTarget||A.isCompressedArrayTexture?n.TEXTURE_2D_ARRAY:n.TEXTURE_2D}function T(A,y,k,it,j,rt=!1){if(A!==null){if(n[A]!==void 0)return n[A];At("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+A+"'")}let ht;it&&(ht=t.get("EXT_texture_norm16"),ht||At("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let Y=y;if(y===n.RED&&(k===n.FLOAT&&(Y=n.R32F),k===n.HALF_FLOAT&&(Y=n.R16F),k===n.UNSIGNED_BYTE&&(Y=n.R8),k===n.UNSIGNED_SHORT&&ht&&(Y=ht.R16_EXT),k===n.SHORT&&ht&&(Y=ht.R16_SNORM_EXT)),y===n.RED_INTEGER&&(k===n.UNSIGNED_BYTE&&(Y=n.R8UI),k===n.UNSIGNED_SHORT&&(Y=n.R16UI),k===n.UNSIGNED_INT&&(Y=n.R32UI),k===n.BYTE&&(Y=n.R8I),k===n.SHORT&&(Y=n.R16I),k===n.INT&&(Y=n.R32I)),y===n.RG&&(k===n.FLOAT&&(Y=n.RG32F),k===n.HALF_FLOAT&&(Y=n.RG16F),k===n.UNSIGNED_BYTE&&(Y=n.RG8),k===n.UNSIGNED_SHORT&&ht&&(Y=ht.RG16_EXT),k===n.SHORT&&ht&&(Y=ht.RG16_SNORM_EXT)),y===n.RG_INTEGER&&(k===n.UNSIGNED_BYTE&&(Y=n.RG8UI),k===n.UNSIGNED_SHORT&&(Y=n.RG16UI),k===n.UNSIGNED_INT&&(Y=n.RG32UI),k===n.BYTE&&(Y=n.RG8I),k===n.SHORT&&(Y=n.RG16I),k===n.INT&&(Y=n.RG32I)),y===n.RGB_INTEGER&&(k===n.UNSIGNED_BYTE&&(Y=n.RGB8UI),k===n.UNSIGNED_SHORT&&(Y=n.RGB16UI),k===n.UNSIGNED_INT&&(Y=n.RGB32UI),k===n.BYTE&&(Y=n.RGB8I),k===n.SHORT&&(Y=n.RGB16I),k===n.INT&&(Y=n.RGB32I)),y===n.RGBA_INTEGER&&(k===n.UNSIGNED_BYTE&&(Y=n.RGBA8UI),k===n.UNSIGNED_SHORT&&(Y=n.RGBA16UI),k===n.UNSIGNED_INT&&(Y=n.RGBA32UI),k===n.BYTE&&(Y=n.RGBA8I),k===n.SHORT&&(Y=n.RGBA16I),k===n.INT&&(Y=n.RGBA32I)),y===n.RGB&&(k===n.UNSIGNED_SHORT&&ht&&(Y=ht.RGB16_EXT),k===n.SHORT&&ht&&(Y=ht.RGB16_SNORM_EXT),k===n.UNSIGNED_INT_5_9_9_9_REV&&(Y=n.RGB9_E5),k===n.UNSIGNED_INT_10F_11F_11F_REV&&(Y=n.R11F_G11F_B10F)),y===n.RGBA){let Z=rt?cr:qt.getTransfer(j);k===n.FLOAT&&(Y=n.RGBA32F),k===n.HALF_FLOAT&&(Y=n.RGBA16F),k===n.UNSIGNED_BYTE&&(Y=Z===jt?n.SRGB8_ALPHA8:n.RGBA8),k===n.UNSIGNED_SHORT&&ht&&(Y=ht.RGBA16_EXT),k===n.SHORT&&ht&&(Y=ht.RGBA16_SNORM_EXT),k===n.UNSIGNED_SHORT_4_4_4_4&&(Y=n.RGBA4),k===n.UNSIGNED_SHORT_5_5_5_1&&(Y=n.RGB5_A1)}return(Y===n.R16F||Y===n.R32F||Y===n.RG16F||Y===n.RG32F||Y===n.RGBA16F||Y===n.RGBA32F)&&t.get("EXT_color_buffer_float"),Y}function x(A,y){let k;return A?y===null||y===Ei||y===Vn?k=n.DEPTH24_STENCIL8:y===xi?k=n.DEPTH32F_STENCIL8:y===Ps&&(k=n.DEPTH24_STENCIL8,At("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):y===null||y===Ei||y===Vn?k=n.DEPTH_COMPONENT24:y===xi?k=n.DEPTH_COMPONENT32F:y===Ps&&(k=n.DEPTH_COMPONENT16),k}function M(A,y){return S(A)===!0||A.isFramebufferTexture&&A.minFilter!==Ue&&A.minFilter!==Ze?Math.log2(Math.max(y.width,y.height))+1:A.mipmaps.length>0?A.mipmaps.length:A.isCompressedTexture&&Array.isArray(A.image)?y.mipmaps.length:1}function D(A){let y=new WeakRef(A);i.get(A).__ref=y,p.add(y),_.register(A,y,y)}function P(A){let y=i.get(A).__ref;y!==void 0&&(p.delete(y),_.unregister(y))}function U(A){W(A.target)}function F(A){I(A.target)}function W(A){A.removeEventListener("dispose",U),P(A),$(A),A.isVideoTexture&&h.delete(A),A.isHTMLTexture&&u.delete(A)}function I(A){A.removeEventListener("dispose",F),P(A),et(A)}function H(){for(let A of p){let y=A.deref();y!==void 0&&(y.isRenderTarget===!0?I(y):W(y))}p.clear(),u.clear()}function $(A){let y=i.get(A);if(y.__webglInit===void 0)return;let k=A.source,it=f.get(k);if(it){let j=it[y.__cacheKey];j.usedTimes--,j.usedTimes===0&&G(A),Object.keys(it).length===0&&f.delete(k)}i.remove(A)}function G(A){let y=i.get(A);n.deleteTexture(y.__webglTexture);let k=A.source,it=f.get(k);delete it[y.__cacheKey],o.memory.textures--}function et(A){let y=i.get(A);y.__depthDisposeCallback&&y.__depthDisposeCallback();let k=A.depthTexture;if(k&&k.renderTarget===A&&W(k),A.isWebGLCubeRenderTarget)for(let j=0;j<6;j++){if(Array.isArray(y.__webglFramebuffer[j]))for(let rt=0;rt<y.__webglFramebuffer[j].length;rt++)n.deleteFramebuffer(y.__webglFramebuffer[j][rt]);else n.deleteFramebuffer(y.__webglFramebuffer[j]);y.__webglDepthbuffer&&n.deleteRenderbuffer(y.__webglDepthbuffer[j])}else{if(Array.isArray(y.__webglFramebuffer))for(let j=0;j<y.__webglFramebuffer.length;j++)n.deleteFramebuffer(y.__webglFramebuffer[j]);else n.deleteFramebuffer(y.__webglFramebuffer);if(y.__webglDepthbuffer&&n.deleteRenderbuffer(y.__webglDepthbuffer),y.__webglMultisampledFramebuffer&&n.deleteFramebuffer(y.__webglMultisampledFramebuffer),y.__webglColorRenderbuffer)for(let j=0;j<y.__webglColorRenderbuffer.length;j++)y.__webglColorRenderbuffer[j]&&n.deleteRenderbuffer(y.__webglColorRenderbuffer[j]);y.__webglDepthRenderbuffer&&n.deleteRenderbuffer(y.__webglDepthRenderbuffer)}let it=A.textures;for(let j=0,rt=it.length;j<rt;j++){let ht=i.get(it[j]);ht.__webglTexture&&(n.deleteTexture(ht.__webglTexture),o.memory.textures--),i.remove(it[j])}i.remove(A)}let X=0;function Q(){X=0}function tt(){return X}function wt(A){X=A}function Ot(){let A=X;return A>=s.maxTextures&&At("WebGLTextures: Trying to use "+(A+1)+" texture units while this GPU supports only "+s.maxTextures),X+=1,A}function J(A){let y=[];return y.push(A.wrapS),y.push(A.wrapT),y.push(A.wrapR||0),y.push(A.magFilter),y.push(A.minFilter),y.push(A.anisotropy),y.push(A.internalFormat),y.push(A.format),y.push(A.type),y.push(A.generateMipmaps),y.push(A.mipmapsAutoUpdate),y.push(A.premultiplyAlpha),y.push(A.flipY),y.push(A.unpackAlignment),y.push(A.colorSpace),y.join()}function mt(A,y){let k=i.get(A);if(A.isVideoTexture&&Ee(A),A.isRenderTargetTexture===!1&&A.isExternalTexture!==!0&&A.version>0&&k.__version!==A.version){let it=A.image;if(it===null)At("WebGLRenderer: Texture marked for update but no image data found.");else if(it.complete===!1)At("WebGLRenderer: Texture marked for update but image is incomplete");else{Se(k,A,y);return}}else A.isExternalTexture&&(k.__webglTexture=A.sourceTexture?A.sourceTexture:null);e.bindTexture(n.TEXTURE_2D,k.__webglTexture,n.TEXTURE0+y)}function yt(A,y){let k=i.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&k.__version!==A.version){Se(k,A,y);return}else A.isExternalTexture&&(k.__webglTexture=A.sourceTexture?A.sourceTexture:null);e.bindTexture(n.TEXTURE_2D_ARRAY,k.__webglTexture,n.TEXTURE0+y)}function Rt(A,y){let k=i.get(A);if(A.isRenderTargetTexture===!1&&A.version>0&&k.__version!==A.version){Se(k,A,y);return}e.bindTexture(n.TEXTURE_3D,k.__webglTexture,n.TEXTURE0+y)}function gt(A,y){let k=i.get(A);if(A.version>0&&k.__version!==A.version){Qe(k,A,y);return}e.bindTexture(n.TEXTURE_CUBE_MAP,k.__webglTexture,n.TEXTURE0+y)}let Bt={[Go]:n.REPEAT,[Li]:n.CLAMP_TO_EDGE,[Vo]:n.MIRRORED_REPEAT},ve={[Ue]:n.NEAREST,[dd]:n.NEAREST_MIPMAP_NEAREST,[Pr]:n.NEAREST_MIPMAP_LINEAR,[Ze]:n.LINEAR,[xa]:n.LINEAR_MIPMAP_NEAREST,[Ji]:n.LINEAR_MIPMAP_LINEAR},It={[gd]:n.NEVER,[$c]:n.ALWAYS,[xd]:n.LESS,[Xc]:n.LEQUAL,[_d]:n.EQUAL,[qc]:n.GEQUAL,[yd]:n.GREATER,[vd]:n.NOTEQUAL};function Qt(A,y){if(y.type===xi&&t.has("OES_texture_float_linear")===!1&&(y.magFilter===Ze||y.magFilter===xa||y.magFilter===Pr||y.magFilter===Ji||y.minFilter===Ze||y.minFilter===xa||y.minFilter===Pr||y.minFilter===Ji)&&At("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),n.texParameteri(A,n.TEXTURE_WRAP_S,Bt[y.wrapS]),n.texParameteri(A,n.TEXTURE_WRAP_T,Bt[y.wrapT]),(A===n.TEXTURE_3D||A===n.TEXTURE_2D_ARRAY)&&n.texParameteri(A,n.TEXTURE_WRAP_R,Bt[y.wrapR]),n.texParameteri(A,n.TEXTURE_MAG_FILTER,ve[y.magFilter]),n.texParameteri(A,n.TEXTURE_MIN_FILTER,ve[y.minFilter]),y.compareFunction&&(n.texParameteri(A,n.TEXTURE_COMPARE_MODE,n.COMPARE_REF_TO_TEXTURE),n.texParameteri(A,n.TEXTURE_COMPARE_FUNC,It[y.compareFunction])),t.has("EXT_texture_filter_anisotropic")===!0){if(y.magFilter===Ue||y.minFilter!==Pr&&y.minFilter!==Ji||y.type===xi&&t.has("OES_texture_float_linear")===!1)return;if(y.anisotropy>1||i.get(y).__currentAnisotropy){let k=t.get("EXT_texture_filter_anisotropic");n.texParameterf(A,k.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(y.anisotropy,s.getMaxAnisotropy())),i.get(y).__currentAnisotropy=y.anisotropy}}}function ee(A,y){let k=!1;A.__webglInit===void 0&&(A.__webglInit=!0,y.addEventListener("dispose",U),D(y));let it=y.source,j=f.get(it);j===void 0&&(j={},f.set(it,j));let rt=J(y);if(rt!==A.__cacheKey){j[rt]===void 0&&(j[rt]={texture:n.createTexture(),usedTimes:0},o.memory.textures++,k=!0),j[rt].usedTimes++;let ht=j[A.__cacheKey];ht!==void 0&&(j[A.__cacheKey].usedTimes--,ht.usedTimes===0&&G(y)),A.__cacheKey=rt,A.__webglTexture=j[rt].texture}return k}function Vt(A,y,k){return Math.floor(Math.floor(A/k)/y)}function Oe(A,y,k,it){let rt=A.updateRanges;if(rt.length===0)e.texSubImage2D(n.TEXTURE_2D,0,0,0,y.width,y.height,k,it,y.data);else{rt.sort((C,K)=>C.start-K.start);let ht=0;for(let C=1;C<rt.length;C++){let K=rt[ht],q=rt[C],lt=K.start+K.count,st=Vt(q.start,y.width,4),ot=Vt(K.start,y.width,4);q.start<=lt+1&&st===ot&&Vt(q.start+q.count-1,y.width,4)===st?K.count=Math.max(K.count,q.start+q.count-K.start):(++ht,rt[ht]=q)}rt.length=ht+1;let Y=e.getParameter(n.UNPACK_ROW_LENGTH),Z=e.getParameter(n.UNPACK_SKIP_PIXELS),at=e.getParameter(n.UNPACK_SKIP_ROWS);e.pixelStorei(n.UNPACK_ROW_LENGTH,y.width);for(let C=0,K=rt.length;C<K;C++){let q=rt[C],lt=Math.floor(q.start/4),st=Math.ceil(q.count/4),ot=lt%y.width,St=Math.floor(lt/y.width),zt=st,nt=1;e.pixelStorei(n.UNPACK_SKIP_PIXELS,ot),e.pixelStorei(n.UNPACK_SKIP_ROWS,St),e.texSubImage2D(n.TEXTURE_2D,0,ot,St,zt,nt,k,it,y.data)}A.clearUpdateRanges(),e.pixelStorei(n.UNPACK_ROW_LENGTH,Y),e.pixelStorei(n.UNPACK_SKIP_PIXELS,Z),e.pixelStorei(n.UNPACK_SKIP_ROWS,at)}}function Se(A,y,k){let it=n.TEXTURE_2D;(y.isDataArrayTexture||y.isCompressedArrayTexture)&&(it=n.TEXTURE_2D_ARRAY),y.isData3DTexture&&(it=n.TEXTURE_3D);let j=ee(A,y),rt=y.source;e.bindTexture(it,A.__webglTexture,n.TEXTURE0+k);let ht=i.get(rt);if(rt.version!==ht.__version||j===!0){if(e.activeTexture(n.TEXTURE0+k),(typeof ImageBitmap<"u"&&y.image instanceof ImageBitmap)===!1){let nt=qt.getPrimaries(qt.workingColorSpace),Tt=y.colorSpace===ji?null:qt.getPrimaries(y.colorSpace),kt=y.colorSpace===ji||nt===Tt?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,y.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,kt)}e.pixelStorei(n.UNPACK_ALIGNMENT,y.unpackAlignment);let Z=b(y.image,!1,s.maxTextureSize);Z=Ct(y,Z);let at=r.convert(y.format,y.colorSpace),C=r.convert(y.type),K=T(y.internalFormat,at,C,y.normalized,y.colorSpace,y.isVideoTexture);Qt(it,y);let q,lt=y.mipmaps,st=y.isVideoTexture!==!0,ot=ht.__version===void 0||j===!0,St=rt.dataReady,zt=M(y,Z);if(y.isDepthTexture)K=x(y.format===Ki,y.type),ot&&(st?e.texStorage2D(n.TEXTURE_2D,1,K,Z.width,Z.height):e.texImage2D(n.TEXTURE_2D,0,K,Z.width,Z.height,0,at,C,null));else if(y.isDataTexture)if(lt.length>0){st&&ot&&e.texStorage2D(n.TEXTURE_2D,zt,K,lt[0].width,lt[0].height);for(let nt=0,Tt=lt.length;nt<Tt;nt++)q=lt[nt],st?St&&e.texSubImage2D(n.TEXTURE_2D,nt,0,0,q.width,q.height,at,C,q.data):e.texImage2D(n.TEXTURE_2D,nt,K,q.width,q.height,0,at,C,q.data);y.generateMipmaps=!1}else st?(ot&&e.texStorage2D(n.TEXTURE_2D,zt,K,Z.width,Z.height),St&&Oe(y,Z,at,C)):e.texImage2D(n.TEXTURE_2D,0,K,Z.width,Z.height,0,at,C,Z.data);else if(y.isCompressedTexture)if(y.isCompressedArrayTexture){st&&ot&&e.texStorage3D(n.TEXTURE_2D_ARRAY,zt,K,lt[0].width,lt[0].height,Z.depth);for(let nt=0,Tt=lt.length;nt<Tt;nt++)if(q=lt[nt],y.format!==Ai)if(at!==null)if(st){if(St)if(y.layerUpdates.size>0){let kt=sh(q.width,q.height,y.format,y.type);for(let ft of y.layerUpdates){let te=q.data.subarray(ft*kt/q.data.BYTES_PER_ELEMENT,(ft+1)*kt/q.data.BYTES_PER_ELEMENT);e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,nt,0,0,ft,q.width,q.height,1,at,te)}}else e.compressedTexSubImage3D(n.TEXTURE_2D_ARRAY,nt,0,0,0,q.width,q.height,Z.depth,at,q.data)}else e.compressedTexImage3D(n.TEXTURE_2D_ARRAY,nt,K,q.width,q.height,Z.depth,0,q.data,0,0);else At("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else st?St&&e.texSubImage3D(n.TEXTURE_2D_ARRAY,nt,0,0,0,q.width,q.height,Z.depth,at,C,q.data):e.texImage3D(n.TEXTURE_2D_ARRAY,nt,K,q.width,q.height,Z.depth,0,at,C,q.data);y.layerUpdates.size>0&&y.clearLayerUpdates()}else{st&&ot&&e.texStorage2D(n.TEXTURE_2D,zt,K,lt[0].width,lt[0].height);for(let nt=0,Tt=lt.length;nt<Tt;nt++)q=lt[nt],y.format!==Ai?at!==null?st?St&&e.compressedTexSubImage2D(n.TEXTURE_2D,nt,0,0,q.width,q.height,at,q.data):e.compressedTexImage2D(n.TEXTURE_2D,nt,K,q.width,q.height,0,q.data):At("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):st?St&&e.texSubImage2D(n.TEXTURE_2D,nt,0,0,q.width,q.height,at,C,q.data):e.texImage2D(n.TEXTURE_2D,nt,K,q.width,q.height,0,at,C,q.data)}else if(y.isDataArrayTexture)if(st){if(ot&&e.texStorage3D(n.TEXTURE_2D_ARRAY,zt,K,Z.width,Z.height,Z.depth),St)if(y.layerUpdates.size>0){let nt=sh(Z.width,Z.height,y.format,y.type);for(let Tt of y.layerUpdates){let kt=Z.data.subarray(Tt*nt/Z.data.BYTES_PER_ELEMENT,(Tt+1)*nt/Z.data.BYTES_PER_ELEMENT);e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,Tt,Z.width,Z.height,1,at,C,kt)}y.clearLayerUpdates()}else e.texSubImage3D(n.TEXTURE_2D_ARRAY,0,0,0,0,Z.width,Z.height,Z.depth,at,C,Z.data)}else e.texImage3D(n.TEXTURE_2D_ARRAY,0,K,Z.width,Z.height,Z.depth,0,at,C,Z.data);else if(y.isData3DTexture)st?(ot&&e.texStorage3D(n.TEXTURE_3D,zt,K,Z.width,Z.height,Z.depth),St&&e.texSubImage3D(n.TEXTURE_3D,0,0,0,0,Z.width,Z.height,Z.depth,at,C,Z.data)):e.texImage3D(n.TEXTURE_3D,0,K,Z.width,Z.height,Z.depth,0,at,C,Z.data);else if(y.isFramebufferTexture){if(ot)if(st)e.texStorage2D(n.TEXTURE_2D,zt,K,Z.width,Z.height);else{let nt=Z.width,Tt=Z.height;for(let kt=0;kt<zt;kt++)e.texImage2D(n.TEXTURE_2D,kt,K,nt,Tt,0,at,C,null),nt>>=1,Tt>>=1}}else if(y.isHTMLTexture){if("texElementImage2D"in n){let nt=n.canvas;if(nt.hasAttribute("layoutsubtree")||nt.setAttribute("layoutsubtree","true"),Z.parentNode!==nt){nt.appendChild(Z),u.add(y),nt.onpaint=Tt=>{let kt=Tt.changedElements;for(let ft of u)kt.includes(ft.image)&&(ft.needsUpdate=!0)},nt.requestPaint();return}if(n.texElementImage2D.length===3)n.texElementImage2D(n.TEXTURE_2D,n.RGBA8,Z);else{let kt=n.RGBA,ft=n.RGBA,te=n.UNSIGNED_BYTE;n.texElementImage2D(n.TEXTURE_2D,0,kt,ft,te,Z)}n.texParameteri(n.TEXTURE_2D,n.TEXTURE_MIN_FILTER,n.LINEAR),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_S,n.CLAMP_TO_EDGE),n.texParameteri(n.TEXTURE_2D,n.TEXTURE_WRAP_T,n.CLAMP_TO_EDGE)}}else if(lt.length>0){if(st&&ot){let nt=Ut(lt[0]);e.texStorage2D(n.TEXTURE_2D,zt,K,nt.width,nt.height)}for(let nt=0,Tt=lt.length;nt<Tt;nt++)q=lt[nt],st?St&&e.texSubImage2D(n.TEXTURE_2D,nt,0,0,at,C,q):e.texImage2D(n.TEXTURE_2D,nt,K,at,C,q);y.generateMipmaps=!1}else if(st){if(ot){let nt=Ut(Z);e.texStorage2D(n.TEXTURE_2D,zt,K,nt.width,nt.height)}St&&e.texSubImage2D(n.TEXTURE_2D,0,0,0,at,C,Z)}else e.texImage2D(n.TEXTURE_2D,0,K,at,C,Z);S(y)&&y.mipmapsAutoUpdate===!0&&w(it),ht.__version=rt.version,y.onUpdate&&y.onUpdate(y)}A.__version=y.version}function Qe(A,y,k){if(y.image.length!==6)return;let it=ee(A,y),j=y.source;e.bindTexture(n.TEXTURE_CUBE_MAP,A.__webglTexture,n.TEXTURE0+k);let rt=i.get(j);if(j.version!==rt.__version||it===!0){e.activeTexture(n.TEXTURE0+k);let ht=qt.getPrimaries(qt.workingColorSpace),Y=y.colorSpace===ji?null:qt.getPrimaries(y.colorSpace),Z=y.colorSpace===ji||ht===Y?n.NONE:n.BROWSER_DEFAULT_WEBGL;e.pixelStorei(n.UNPACK_FLIP_Y_WEBGL,y.flipY),e.pixelStorei(n.UNPACK_PREMULTIPLY_ALPHA_WEBGL,y.premultiplyAlpha),e.pixelStorei(n.UNPACK_ALIGNMENT,y.unpackAlignment),e.pixelStorei(n.UNPACK_COLORSPACE_CONVERSION_WEBGL,Z);let at=y.isCompressedTexture||y.image[0].isCompressedTexture,C=y.image[0]&&y.image[0].isDataTexture,K=[];for(let ft=0;ft<6;ft++)!at&&!C?K[ft]=b(y.image[ft],!0,s.maxCubemapSize):K[ft]=C?y.image[ft].image:y.image[ft],K[ft]=Ct(y,K[ft]);let q=K[0],lt=r.convert(y.format,y.colorSpace),st=r.convert(y.type),ot=T(y.internalFormat,lt,st,y.normalized,y.colorSpace),St=y.isVideoTexture!==!0,zt=rt.__version===void 0||it===!0,nt=j.dataReady,Tt=M(y,q);Qt(n.TEXTURE_CUBE_MAP,y);let kt;if(y.isDepthTexture){if(ot=x(y.format===Ki,y.type),zt)if(St)e.texStorage2D(n.TEXTURE_CUBE_MAP,1,ot,q.width,q.height);else for(let ft=0;ft<6;ft++)e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,ot,q.width,q.height,0,lt,st,null)}else if(at){St&&zt&&e.texStorage2D(n.TEXTURE_CUBE_MAP,Tt,ot,q.width,q.height);for(let ft=0;ft<6;ft++){kt=K[ft].mipmaps;for(let te=0;te<kt.length;te++){let Pe=kt[te];y.format!==Ai?lt!==null?St?nt&&e.compressedTexSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te,0,0,Pe.width,Pe.height,lt,Pe.data):e.compressedTexImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te,ot,Pe.width,Pe.height,0,Pe.data):At("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):St?nt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te,0,0,Pe.width,Pe.height,lt,st,Pe.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te,ot,Pe.width,Pe.height,0,lt,st,Pe.data)}}}else{if(kt=y.mipmaps,St&&zt){kt.length>0&&Tt++;let ft=Ut(K[0]);e.texStorage2D(n.TEXTURE_CUBE_MAP,Tt,ot,ft.width,ft.height)}for(let ft=0;ft<6;ft++)if(C){St?nt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,0,0,K[ft].width,K[ft].height,lt,st,K[ft].data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,ot,K[ft].width,K[ft].height,0,lt,st,K[ft].data);for(let te=0;te<kt.length;te++){let tn=kt[te].image[ft].image;St?nt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te+1,0,0,tn.width,tn.height,lt,st,tn.data):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te+1,ot,tn.width,tn.height,0,lt,st,tn.data)}}else{St?nt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,0,0,lt,st,K[ft]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,0,ot,lt,st,K[ft]);for(let te=0;te<kt.length;te++){let Pe=kt[te];St?nt&&e.texSubImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te+1,0,0,lt,st,Pe.image[ft]):e.texImage2D(n.TEXTURE_CUBE_MAP_POSITIVE_X+ft,te+1,ot,lt,st,Pe.image[ft])}}}S(y)&&y.mipmapsAutoUpdate===!0&&w(n.TEXTURE_CUBE_MAP),rt.__version=j.version,y.onUpdate&&y.onUpdate(y)}A.__version=y.version}function fe(A,y,k,it,j,rt){let ht=r.convert(k.format,k.colorSpace),Y=r.convert(k.type),Z=T(k.internalFormat,ht,Y,k.normalized,k.colorSpace),at=i.get(y),C=i.get(k);if(C.__renderTarget=y,!at.__hasExternalTextures){let K=Math.max(1,y.width>>rt),q=Math.max(1,y.height>>rt);j===n.TEXTURE_3D||j===n.TEXTURE_2D_ARRAY?e.texImage3D(j,rt,Z,K,q,y.depth,0,ht,Y,null):e.texImage2D(j,rt,Z,K,q,0,ht,Y,null)}e.bindFramebuffer(n.FRAMEBUFFER,A),dt(y)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,it,j,C.__webglTexture,0,ce(y)):(j===n.TEXTURE_2D||j>=n.TEXTURE_CUBE_MAP_POSITIVE_X&&j<=n.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&n.framebufferTexture2D(n.FRAMEBUFFER,it,j,C.__webglTexture,rt),e.bindFramebuffer(n.FRAMEBUFFER,null)}function Ci(A,y,k){if(n.bindRenderbuffer(n.RENDERBUFFER,A),y.depthBuffer){let it=y.depthTexture,j=it&&it.isDepthTexture?it.type:null,rt=x(y.stencilBuffer,j),ht=y.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;dt(y)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ce(y),rt,y.width,y.height):k?n.renderbufferStorageMultisample(n.RENDERBUFFER,ce(y),rt,y.width,y.height):n.renderbufferStorage(n.RENDERBUFFER,rt,y.width,y.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,ht,n.RENDERBUFFER,A)}else{let it=y.textures;for(let j=0;j<it.length;j++){let rt=it[j],ht=r.convert(rt.format,rt.colorSpace),Y=r.convert(rt.type),Z=T(rt.internalFormat,ht,Y,rt.normalized,rt.colorSpace);dt(y)?a.renderbufferStorageMultisampleEXT(n.RENDERBUFFER,ce(y),Z,y.width,y.height):k?n.renderbufferStorageMultisample(n.RENDERBUFFER,ce(y),Z,y.width,y.height):n.renderbufferStorage(n.RENDERBUFFER,Z,y.width,y.height)}}n.bindRenderbuffer(n.RENDERBUFFER,null)}function Ce(A,y,k){let it=y.isWebGLCubeRenderTarget===!0;if(e.bindFramebuffer(n.FRAMEBUFFER,A),!(y.depthTexture&&y.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let j=i.get(y.depthTexture);j.__renderTarget=y;let rt=it?y.depthTexture.image[0]:y.depthTexture.image;(!j.__webglTexture||rt.width!==y.width||rt.height!==y.height)&&(rt.width=y.width,rt.height=y.height,y.depthTexture.needsUpdate=!0),it?gt(y.depthTexture,0):mt(y.depthTexture,0);let ht=j.__webglTexture,Y=ce(y),Z=it?n.TEXTURE_CUBE_MAP_POSITIVE_X+k:n.TEXTURE_2D,at=y.depthTexture.format===Ki?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;if(y.depthTexture.format===Wi)dt(y)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,at,Z,ht,0,Y):n.framebufferTexture2D(n.FRAMEBUFFER,at,Z,ht,0);else if(y.depthTexture.format===Ki)dt(y)?a.framebufferTexture2DMultisampleEXT(n.FRAMEBUFFER,at,Z,ht,0,Y):n.framebufferTexture2D(n.FRAMEBUFFER,at,Z,ht,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function hi(A){let y=i.get(A),k=A.isWebGLCubeRenderTarget===!0;if(y.__boundDepthTexture!==A.depthTexture){let it=A.depthTexture;if(y.__depthDisposeCallback&&y.__depthDisposeCallback(),it){let j=()=>{delete y.__boundDepthTexture,delete y.__depthDisposeCallback,it.removeEventListener("dispose",j)};it.addEventListener("dispose",j),y.__depthDisposeCallback=j}y.__boundDepthTexture=it}if(A.depthTexture&&!y.__autoAllocateDepthBuffer)if(k)for(let it=0;it<6;it++)Ce(y.__webglFramebuffer[it],A,it);else A.texture.mipmaps.length>0?Ce(y.__webglFramebuffer[0],A,0):Ce(y.__webglFramebuffer,A,0);else if(k){y.__webglDepthbuffer=[];for(let it=0;it<6;it++)if(e.bindFramebuffer(n.FRAMEBUFFER,y.__webglFramebuffer[it]),y.__webglDepthbuffer[it]===void 0)y.__webglDepthbuffer[it]=n.createRenderbuffer(),Ci(y.__webglDepthbuffer[it],A,!1);else{let j=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,rt=y.__webglDepthbuffer[it];n.bindRenderbuffer(n.RENDERBUFFER,rt),n.framebufferRenderbuffer(n.FRAMEBUFFER,j,n.RENDERBUFFER,rt)}}else if(A.texture.mipmaps.length>0?e.bindFramebuffer(n.FRAMEBUFFER,y.__webglFramebuffer[0]):e.bindFramebuffer(n.FRAMEBUFFER,y.__webglFramebuffer),y.__webglDepthbuffer===void 0)y.__webglDepthbuffer=n.createRenderbuffer(),Ci(y.__webglDepthbuffer,A,!1);else{let j=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,rt=y.__webglDepthbuffer;n.bindRenderbuffer(n.RENDERBUFFER,rt),n.framebufferRenderbuffer(n.FRAMEBUFFER,j,n.RENDERBUFFER,rt)}e.bindFramebuffer(n.FRAMEBUFFER,null)}function ui(A,y,k){let it=i.get(A);y!==void 0&&fe(it.__webglFramebuffer,A,A.texture,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,0),k!==void 0&&hi(A)}function di(A){let y=A.texture,k=i.get(A),it=i.get(y);A.addEventListener("dispose",F),D(A);let j=A.textures,rt=A.isWebGLCubeRenderTarget===!0,ht=j.length>1;if(ht||(it.__webglTexture===void 0&&(it.__webglTexture=n.createTexture()),it.__version=y.version,o.memory.textures++),rt){k.__webglFramebuffer=[];for(let Y=0;Y<6;Y++)if(y.mipmaps.length>0){k.__webglFramebuffer[Y]=[];for(let Z=0;Z<y.mipmaps.length;Z++)k.__webglFramebuffer[Y][Z]=n.createFramebuffer()}else k.__webglFramebuffer[Y]=n.createFramebuffer()}else{if(y.mipmaps.length>0){k.__webglFramebuffer=[];for(let Y=0;Y<y.mipmaps.length;Y++)k.__webglFramebuffer[Y]=n.createFramebuffer()}else k.__webglFramebuffer=n.createFramebuffer();if(ht)for(let Y=0,Z=j.length;Y<Z;Y++){let at=i.get(j[Y]);at.__webglTexture===void 0&&(at.__webglTexture=n.createTexture(),o.memory.textures++)}if(A.samples>0&&dt(A)===!1){k.__webglMultisampledFramebuffer=n.createFramebuffer(),k.__webglColorRenderbuffer=[],e.bindFramebuffer(n.FRAMEBUFFER,k.__webglMultisampledFramebuffer);for(let Y=0;Y<j.length;Y++){let Z=j[Y];k.__webglColorRenderbuffer[Y]=n.createRenderbuffer(),n.bindRenderbuffer(n.RENDERBUFFER,k.__webglColorRenderbuffer[Y]);let at=r.convert(Z.format,Z.colorSpace),C=r.convert(Z.type),K=T(Z.internalFormat,at,C,Z.normalized,Z.colorSpace,A.isXRRenderTarget===!0),q=ce(A);n.renderbufferStorageMultisample(n.RENDERBUFFER,q,K,A.width,A.height),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+Y,n.RENDERBUFFER,k.__webglColorRenderbuffer[Y])}n.bindRenderbuffer(n.RENDERBUFFER,null),A.depthBuffer&&(k.__webglDepthRenderbuffer=n.createRenderbuffer(),Ci(k.__webglDepthRenderbuffer,A,!0)),e.bindFramebuffer(n.FRAMEBUFFER,null)}}if(rt){e.bindTexture(n.TEXTURE_CUBE_MAP,it.__webglTexture),Qt(n.TEXTURE_CUBE_MAP,y);for(let Y=0;Y<6;Y++)if(y.mipmaps.length>0)for(let Z=0;Z<y.mipmaps.length;Z++)fe(k.__webglFramebuffer[Y][Z],A,y,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+Y,Z);else fe(k.__webglFramebuffer[Y],A,y,n.COLOR_ATTACHMENT0,n.TEXTURE_CUBE_MAP_POSITIVE_X+Y,0);S(y)?w(n.TEXTURE_CUBE_MAP):y.mipmaps.length>0&&n.texParameteri(n.TEXTURE_CUBE_MAP,n.TEXTURE_MAX_LEVEL,y.mipmaps.length-1),e.unbindTexture()}else if(ht){for(let Y=0,Z=j.length;Y<Z;Y++){let at=j[Y],C=i.get(at),K=n.TEXTURE_2D;(A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(K=A.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(K,C.__webglTexture),Qt(K,at),fe(k.__webglFramebuffer,A,at,n.COLOR_ATTACHMENT0+Y,K,0),S(at)&&w(K)}e.unbindTexture()}else{let Y=n.TEXTURE_2D;if((A.isWebGL3DRenderTarget||A.isWebGLArrayRenderTarget)&&(Y=A.isWebGL3DRenderTarget?n.TEXTURE_3D:n.TEXTURE_2D_ARRAY),e.bindTexture(Y,it.__webglTexture),Qt(Y,y),y.mipmaps.length>0)for(let Z=0;Z<y.mipmaps.length;Z++)fe(k.__webglFramebuffer[Z],A,y,n.COLOR_ATTACHMENT0,Y,Z);else fe(k.__webglFramebuffer,A,y,n.COLOR_ATTACHMENT0,Y,0);S(y)?w(Y):y.mipmaps.length>0&&n.texParameteri(Y,n.TEXTURE_MAX_LEVEL,y.mipmaps.length-1),e.unbindTexture()}A.depthBuffer&&hi(A)}function O(A){let y=A.textures;for(let k=0,it=y.length;k<it;k++){let j=y[k];if(S(j)&&j.mipmapsAutoUpdate===!0){let rt=E(A),ht=i.get(j).__webglTexture;e.bindTexture(rt,ht),w(rt),e.unbindTexture()}}}let fi=[];function le(A){if(A.samples>0){if(dt(A)===!1){let y=A.textures,k=A.width,it=A.height,j=n.COLOR_BUFFER_BIT,rt=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT,ht=i.get(A),Y=y.length>1;if(Y)for(let at=0;at<y.length;at++)e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+at,n.RENDERBUFFER,null),e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+at,n.TEXTURE_2D,null,0);e.bindFramebuffer(n.READ_FRAMEBUFFER,ht.__webglMultisampledFramebuffer),A.texture.mipmaps.length>0?e.bindFramebuffer(n.DRAW_FRAMEBUFFER,ht.__webglFramebuffer[0]):e.bindFramebuffer(n.DRAW_FRAMEBUFFER,ht.__webglFramebuffer);for(let at=0;at<y.length;at++){if(A.resolveDepthBuffer&&(A.depthBuffer&&(j|=n.DEPTH_BUFFER_BIT),A.stencilBuffer&&A.resolveStencilBuffer&&(j|=n.STENCIL_BUFFER_BIT)),Y){n.framebufferRenderbuffer(n.READ_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.RENDERBUFFER,ht.__webglColorRenderbuffer[at]);let C=i.get(y[at]).__webglTexture;n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0,n.TEXTURE_2D,C,0)}n.blitFramebuffer(0,0,k,it,0,0,k,it,j,n.NEAREST),l===!0&&(fi.length=0,fi.push(n.COLOR_ATTACHMENT0+at),A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&fi.push(rt),n.invalidateFramebuffer(n.READ_FRAMEBUFFER,fi))}if(e.bindFramebuffer(n.READ_FRAMEBUFFER,null),e.bindFramebuffer(n.DRAW_FRAMEBUFFER,null),Y)for(let at=0;at<y.length;at++){e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglMultisampledFramebuffer),n.framebufferRenderbuffer(n.FRAMEBUFFER,n.COLOR_ATTACHMENT0+at,n.RENDERBUFFER,ht.__webglColorRenderbuffer[at]);let C=i.get(y[at]).__webglTexture;e.bindFramebuffer(n.FRAMEBUFFER,ht.__webglFramebuffer),n.framebufferTexture2D(n.DRAW_FRAMEBUFFER,n.COLOR_ATTACHMENT0+at,n.TEXTURE_2D,C,0)}e.bindFramebuffer(n.DRAW_FRAMEBUFFER,ht.__webglMultisampledFramebuffer)}else if(A.depthBuffer&&A.storeMultisampledDepthBuffer===!1&&l){let y=A.stencilBuffer?n.DEPTH_STENCIL_ATTACHMENT:n.DEPTH_ATTACHMENT;n.invalidateFramebuffer(n.DRAW_FRAMEBUFFER,[y])}}}function ce(A){return Math.min(s.maxSamples,A.samples)}function dt(A){let y=i.get(A);return A.samples>0&&t.has("WEBGL_multisampled_render_to_texture")===!0&&y.__useRenderToTexture!==!1}function Ee(A){let y=o.render.frame;h.get(A)!==y&&(h.set(A,y),A.update())}function Ct(A,y){let k=A.colorSpace,it=A.format,j=A.type;return A.isCompressedTexture===!0||A.isVideoTexture===!0||k!==lr&&k!==ji&&(qt.getTransfer(k)===jt?(it!==Ai||j!==ei)&&At("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):Dt("WebGLTextures: Unsupported texture color space:",k)),y}function Ut(A){return typeof HTMLImageElement<"u"&&A instanceof HTMLImageElement?(c.width=A.naturalWidth||A.width,c.height=A.naturalHeight||A.height):typeof VideoFrame<"u"&&A instanceof VideoFrame?(c.width=A.displayWidth,c.height=A.displayHeight):(c.width=A.width,c.height=A.height),c}this.allocateTextureUnit=Ot,this.resetTextureUnits=Q,this.getTextureUnits=tt,this.setTextureUnits=wt,this.setTexture2D=mt,this.setTexture2DArray=yt,this.setTexture3D=Rt,this.setTextureCube=gt,this.rebindTextures=ui,this.setupRenderTarget=di,this.updateRenderTargetMipmap=O,this.updateMultisampleRenderTarget=le,this.setupDepthRenderbuffer=hi,this.setupFrameBufferTexture=fe,this.useMultisampledRTT=dt,this.dispose=H}function ev(n,t){function e(i,s=ji){let r,o=qt.getTransfer(s);if(i===ei)return n.UNSIGNED_BYTE;if(i===ya)return n.UNSIGNED_SHORT_4_4_4_4;if(i===va)return n.UNSIGNED_SHORT_5_5_5_1;if(i===Hc)return n.UNSIGNED_INT_5_9_9_9_REV;if(i===Gc)return n.UNSIGNED_INT_10F_11F_11F_REV;if(i===kc)return n.BYTE;if(i===zc)return n.SHORT;if(i===Ps)return n.UNSIGNED_SHORT;if(i===_a)return n.INT;if(i===Ei)return n.UNSIGNED_INT;if(i===xi)return n.FLOAT;if(i===Ti)return n.HALF_FLOAT;if(i===Vc)return n.ALPHA;if(i===Wc)return n.RGB;if(i===Ai)return n.RGBA;if(i===Wi)return n.DEPTH_COMPONENT;if(i===Ki)return n.DEPTH_STENCIL;if(i===ba)return n.RED;if(i===wa)return n.RED_INTEGER;if(i===bn)return n.RG;if(i===Ma)return n.RG_INTEGER;if(i===Sa)return n.RGBA_INTEGER;if(i===Ir||i===Lr||i===Dr||i===Nr)if(o===jt)if(r=t.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(i===Ir)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(i===Lr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(i===Dr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(i===Nr)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=t.get("WEBGL_compressed_texture_s3tc"),r!==null){if(i===Ir)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(i===Lr)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(i===Dr)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(i===Nr)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(i===Ea||i===Ta||i===Aa||i===Ra)if(r=t.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(i===Ea)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(i===Ta)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(i===Aa)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(i===Ra)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(i===Ca||i===Pa||i===Ia||i===La||i===Da||i===Ur||i===Na)if(r=t.get("WEBGL_compressed_texture_etc"),r!==null){if(i===Ca||i===Pa)return o===jt?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(i===Ia)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(i===La)return r.COMPRESSED_R11_EAC;if(i===Da)return r.COMPRESSED_SIGNED_R11_EAC;if(i===Ur)return r.COMPRESSED_RG11_EAC;if(i===Na)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(i===Ua||i===Oa||i===Fa||i===Ba||i===ka||i===za||i===Ha||i===Ga||i===Va||i===Wa||i===Xa||i===qa||i===$a||i===Ya)if(r=t.get("WEBGL_compressed_texture_astc"),r!==null){if(i===Ua)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(i===Oa)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(i===Fa)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(i===Ba)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(i===ka)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(i===za)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(i===Ha)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(i===Ga)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(i===Va)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(i===Wa)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(i===Xa)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(i===qa)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(i===$a)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(i===Ya)return o===jt?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(i===Za||i===Ja||i===Ka)if(r=t.get("EXT_texture_compression_bptc"),r!==null){if(i===Za)return o===jt?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(i===Ja)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(i===Ka)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(i===ja||i===Qa||i===Or||i===tl)if(r=t.get("EXT_texture_compression_rgtc"),r!==null){if(i===ja)return r.COMPRESSED_RED_RGTC1_EXT;if(i===Qa)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(i===Or)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(i===tl)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return i===Vn?n.UNSIGNED_INT_24_8:n[i]!==void 0?n[i]:null}return{convert:e}}var iv=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,nv=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,fh=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(t,e){if(this.texture===null){let i=new vr(t.texture);(t.depthNear!==e.depthNear||t.depthFar!==e.depthFar)&&(this.depthNear=t.depthNear,this.depthFar=t.depthFar),this.texture=i}}getMesh(t){if(this.texture!==null&&this.mesh===null){let e=t.cameras[0].viewport,i=new Xe({vertexShader:iv,fragmentShader:nv,uniforms:{depthColor:{value:this.texture},depthWidth:{value:e.z},depthHeight:{value:e.w}}});this.mesh=new de(new Fn(20,20),i)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},ph=class extends Si{constructor(t,e){super();let i=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,u=null,d=null,f=null,p=null,_=typeof XRWebGLBinding<"u",g=new fh,m={},b=e.getContextAttributes(),S=null,w=null,E=[],T=[],x=new Lt,M=null,D=null,P=new Ye;P.viewport=new he;let U=new Ye;U.viewport=new he;let F=[P,U],W=new fa,I=null,H=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(J){let mt=E[J];return mt===void 0&&(mt=new ws,E[J]=mt),mt.getTargetRaySpace()},this.getControllerGrip=function(J){let mt=E[J];return mt===void 0&&(mt=new ws,E[J]=mt),mt.getGripSpace()},this.getHand=function(J){let mt=E[J];return mt===void 0&&(mt=new ws,E[J]=mt),mt.getHandSpace()};function $(J){let mt=T.indexOf(J.inputSource);if(mt===-1)return;let yt=E[mt];yt!==void 0&&(yt.update(J.inputSource,J.frame,c||o),yt.dispatchEvent({type:J.type,data:J.inputSource}))}function G(){s.removeEventListener("select",$),s.removeEventListener("selectstart",$),s.removeEventListener("selectend",$),s.removeEventListener("squeeze",$),s.removeEventListener("squeezestart",$),s.removeEventListener("squeezeend",$),s.removeEventListener("end",G),s.removeEventListener("inputsourceschange",et);for(let J=0;J<E.length;J++){let mt=T[J];mt!==null&&(T[J]=null,E[J].disconnect(mt))}I=null,H=null,g.reset();for(let J in m)delete m[J];if(t.setRenderTarget(S),f=null,d=null,u=null,s=null,w=null,Ot.stop(),i.isPresenting=!1,t.setPixelRatio(M),t.setSize(x.width,x.height,!1),D!==null){let J=D.camera;J.fov=D.fov,J.zoom=D.zoom,J.updateProjectionMatrix(),D=null}i.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(J){r=J,i.isPresenting===!0&&At("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(J){a=J,i.isPresenting===!0&&At("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(J){c=J},this.getBaseLayer=function(){return d!==null?d:f},this.getBinding=function(){return u===null&&_&&(u=new XRWebGLBinding(s,e)),u},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(J){if(s=J,s!==null){if(S=t.getRenderTarget(),s.addEventListener("select",$),s.addEventListener("selectstart",$),s.addEventListener("selectend",$),s.addEventListener("squeeze",$),s.addEventListener("squeezestart",$),s.addEventListener("squeezeend",$),s.addEventListener("end",G),s.addEventListener("inputsourceschange",et),b.xrCompatible!==!0&&await e.makeXRCompatible(),M=t.getPixelRatio(),t.getSize(x),_&&"createProjectionLayer"in XRWebGLBinding.prototype){let yt=null,Rt=null,gt=null;b.depth&&(gt=b.stencil?e.DEPTH24_STENCIL8:e.DEPTH_COMPONENT24,yt=b.stencil?Ki:Wi,Rt=b.stencil?Vn:Ei);let Bt={colorFormat:e.RGBA8,depthFormat:gt,scaleFactor:r};u=this.getBinding(),d=u.createProjectionLayer(Bt),s.updateRenderState({layers:[d]}),t.setPixelRatio(1),t.setSize(d.textureWidth,d.textureHeight,!1),w=new Ke(d.textureWidth,d.textureHeight,{format:Ai,type:ei,depthTexture:new Yi(d.textureWidth,d.textureHeight,Rt,void 0,void 0,void 0,void 0,void 0,void 0,yt),stencilBuffer:b.stencil,colorSpace:t.outputColorSpace,samples:b.antialias?4:0,resolveDepthBuffer:d.ignoreDepthValues===!1,resolveStencilBuffer:d.ignoreDepthValues===!1,storeMultisampledDepthBuffer:d.ignoreDepthValues===!1,storeMultisampledStencilBuffer:d.ignoreDepthValues===!1})}else{let yt={antialias:b.antialias,alpha:!0,depth:b.depth,stencil:b.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,e,yt),s.updateRenderState({baseLayer:f}),t.setPixelRatio(1),t.setSize(f.framebufferWidth,f.framebufferHeight,!1),w=new Ke(f.framebufferWidth,f.framebufferHeight,{format:Ai,type:ei,colorSpace:t.outputColorSpace,stencilBuffer:b.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}w.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),Ot.setContext(s),Ot.start(),i.isPresenting=!0,i.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return g.getDepthTexture()};function et(J){for(let mt=0;mt<J.removed.length;mt++){let yt=J.removed[mt],Rt=T.indexOf(yt);Rt>=0&&(T[Rt]=null,E[Rt].disconnect(yt))}for(let mt=0;mt<J.added.length;mt++){let yt=J.added[mt],Rt=T.indexOf(yt);if(Rt===-1){for(let Bt=0;Bt<E.length;Bt++)if(Bt>=T.length){T.push(yt),Rt=Bt;break}else if(T[Bt]===null){T[Bt]=yt,Rt=Bt;break}if(Rt===-1)break}let gt=E[Rt];gt&&gt.connect(yt)}}function X(J,mt){mt===null?J.matrixWorld.copy(J.matrix):J.matrixWorld.multiplyMatrices(mt.matrixWorld,J.matrix),J.matrixWorldInverse.copy(J.matrixWorld).invert()}this.updateCamera=function(J){if(s===null)return;let mt=J.near,yt=J.far;g.texture!==null&&(g.depthNear>0&&(mt=g.depthNear),g.depthFar>0&&(yt=g.depthFar)),W.near=U.near=P.near=mt,W.far=U.far=P.far=yt,(I!==W.near||H!==W.far)&&(s.updateRenderState({depthNear:W.near,depthFar:W.far}),I=W.near,H=W.far),W.layers.mask=J.layers.mask|6,P.layers.mask=W.layers.mask&-5,U.layers.mask=W.layers.mask&-3;let Rt=J.parent,gt=W.cameras;X(W,Rt);for(let Bt=0;Bt<gt.length;Bt++)X(gt[Bt],Rt);W.projectionMatrix.copy(P.projectionMatrix),W.projectionMatrixInverse.copy(P.projectionMatrixInverse),D===null&&J.isPerspectiveCamera&&(D={camera:J,fov:J.fov,zoom:J.zoom}),Q(J,W,Rt)};function Q(J,mt,yt){yt===null?J.matrix.copy(mt.matrixWorld):(J.matrix.copy(yt.matrixWorld),J.matrix.invert(),J.matrix.multiply(mt.matrixWorld)),J.matrix.decompose(J.position,J.quaternion,J.scale),J.updateMatrixWorld(!0),J.projectionMatrix.copy(mt.projectionMatrix),J.projectionMatrixInverse.copy(mt.projectionMatrixInverse),J.isPerspectiveCamera&&(J.fov=vs*2*Math.atan(1/J.projectionMatrix.elements[5]),J.zoom=1)}this.getCamera=function(){return W},this.getFoveation=function(){if(!(d===null&&f===null))return l},this.setFoveation=function(J){l=J,d!==null&&(d.fixedFoveation=J),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=J)},this.hasDepthSensing=function(){return g.texture!==null},this.getDepthSensingMesh=function(){return g.getMesh(W)},this.getCameraTexture=function(J){return m[J]};let tt=null;function wt(J,mt){if(h=mt.getViewerPose(c||o),p=mt,h!==null){let yt=h.views;f!==null&&(t.setRenderTargetFramebuffer(w,f.framebuffer),t.setRenderTarget(w));let Rt=!1;yt.length!==W.cameras.length&&(W.cameras.length=0,Rt=!0);for(let It=0;It<yt.length;It++){let Qt=yt[It],ee=null;if(f!==null)ee=f.getViewport(Qt);else{let Oe=u.getViewSubImage(d,Qt);ee=Oe.viewport,It===0&&(t.setRenderTargetTextures(w,Oe.colorTexture,Oe.depthStencilTexture),t.setRenderTarget(w))}let Vt=F[It];Vt===void 0&&(Vt=new Ye,Vt.layers.enable(It),Vt.viewport=new he,F[It]=Vt),Vt.matrix.fromArray(Qt.transform.matrix),Vt.matrix.decompose(Vt.position,Vt.quaternion,Vt.scale),Vt.projectionMatrix.fromArray(Qt.projectionMatrix),Vt.projectionMatrixInverse.copy(Vt.projectionMatrix).invert(),Vt.viewport.set(ee.x,ee.y,ee.width,ee.height),It===0&&(W.matrix.copy(Vt.matrix),W.matrix.decompose(W.position,W.quaternion,W.scale)),Rt===!0&&W.cameras.push(Vt)}let gt=s.enabledFeatures;if(gt&&gt.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&_){u=i.getBinding();let It=u.getDepthInformation(yt[0]);It&&It.isValid&&It.texture&&g.init(It,s.renderState)}if(gt&&gt.includes("camera-access")&&_){t.state.unbindTexture(),u=i.getBinding();for(let It=0;It<yt.length;It++){let Qt=yt[It].camera;if(Qt){let ee=m[Qt];ee||(ee=new vr,m[Qt]=ee);let Vt=u.getCameraImage(Qt);ee.sourceTexture=Vt}}}}for(let yt=0;yt<E.length;yt++){let Rt=T[yt],gt=E[yt];Rt!==null&&gt!==void 0&&gt.update(Rt,mt,c||o)}tt&&tt(J,mt),mt.detectedPlanes&&i.dispatchEvent({type:"planesdetected",data:mt}),p=null}let Ot=new Qd;Ot.setAnimationLoop(wt),this.setAnimationLoop=function(J){tt=J},this.dispose=function(){}}},sv=new $t,hf=new Nt;hf.set(-1,0,0,0,1,0,0,0,1);function rv(n,t){function e(g,m){g.matrixAutoUpdate===!0&&g.updateMatrix(),m.value.copy(g.matrix)}function i(g,m){m.color.getRGB(g.fogColor.value,eh(n)),m.isFog?(g.fogNear.value=m.near,g.fogFar.value=m.far):m.isFogExp2&&(g.fogDensity.value=m.density)}function s(g,m,b,S,w){m.isNodeMaterial?m.uniformsNeedUpdate=!1:m.isMeshBasicMaterial?r(g,m):m.isMeshLambertMaterial?(r(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshToonMaterial?(r(g,m),u(g,m)):m.isMeshPhongMaterial?(r(g,m),h(g,m),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)):m.isMeshStandardMaterial?(r(g,m),d(g,m),m.isMeshPhysicalMaterial&&f(g,m,w)):m.isMeshMatcapMaterial?(r(g,m),p(g,m)):m.isMeshDepthMaterial?r(g,m):m.isMeshDistanceMaterial?(r(g,m),_(g,m)):m.isMeshNormalMaterial?r(g,m):m.isLineBasicMaterial?(o(g,m),m.isLineDashedMaterial&&a(g,m)):m.isPointsMaterial?l(g,m,b,S):m.isSpriteMaterial?c(g,m):m.isShadowMaterial?(g.color.value.copy(m.color),g.opacity.value=m.opacity):m.isShaderMaterial&&(m.uniformsNeedUpdate=!1)}function r(g,m){g.opacity.value=m.opacity,m.color&&g.diffuse.value.copy(m.color),m.emissive&&g.emissive.value.copy(m.emissive).multiplyScalar(m.emissiveIntensity),m.map&&(g.map.value=m.map,e(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,e(m.alphaMap,g.alphaMapTransform)),m.bumpMap&&(g.bumpMap.value=m.bumpMap,e(m.bumpMap,g.bumpMapTransform),g.bumpScale.value=m.bumpScale,m.side===je&&(g.bumpScale.value*=-1)),m.normalMap&&(g.normalMap.value=m.normalMap,e(m.normalMap,g.normalMapTransform),g.normalScale.value.copy(m.normalScale),m.side===je&&g.normalScale.value.negate()),m.displacementMap&&(g.displacementMap.value=m.displacementMap,e(m.displacementMap,g.displacementMapTransform),g.displacementScale.value=m.displacementScale,g.displacementBias.value=m.displacementBias),m.emissiveMap&&(g.emissiveMap.value=m.emissiveMap,e(m.emissiveMap,g.emissiveMapTransform)),m.specularMap&&(g.specularMap.value=m.specularMap,e(m.specularMap,g.specularMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest);let b=t.get(m),S=b.envMap,w=b.envMapRotation;S&&(g.envMap.value=S,g.envMapRotation.value.setFromMatrix4(sv.makeRotationFromEuler(w)).transpose(),S.isCubeTexture&&S.isRenderTargetTexture===!1&&g.envMapRotation.value.premultiply(hf),g.reflectivity.value=m.reflectivity,g.ior.value=m.ior,g.refractionRatio.value=m.refractionRatio),m.lightMap&&(g.lightMap.value=m.lightMap,g.lightMapIntensity.value=m.lightMapIntensity,e(m.lightMap,g.lightMapTransform)),m.aoMap&&(g.aoMap.value=m.aoMap,g.aoMapIntensity.value=m.aoMapIntensity,e(m.aoMap,g.aoMapTransform))}function o(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,m.map&&(g.map.value=m.map,e(m.map,g.mapTransform))}function a(g,m){g.dashSize.value=m.dashSize,g.totalSize.value=m.dashSize+m.gapSize,g.scale.value=m.scale}function l(g,m,b,S){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.size.value=m.size*b,g.scale.value=S*.5,m.map&&(g.map.value=m.map,e(m.map,g.uvTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,e(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function c(g,m){g.diffuse.value.copy(m.color),g.opacity.value=m.opacity,g.rotation.value=m.rotation,m.map&&(g.map.value=m.map,e(m.map,g.mapTransform)),m.alphaMap&&(g.alphaMap.value=m.alphaMap,e(m.alphaMap,g.alphaMapTransform)),m.alphaTest>0&&(g.alphaTest.value=m.alphaTest)}function h(g,m){g.specular.value.copy(m.specular),g.shininess.value=Math.max(m.shininess,1e-4)}function u(g,m){m.gradientMap&&(g.gradientMap.value=m.gradientMap)}function d(g,m){g.metalness.value=m.metalness,m.metalnessMap&&(g.metalnessMap.value=m.metalnessMap,e(m.metalnessMap,g.metalnessMapTransform)),g.roughness.value=m.roughness,m.roughnessMap&&(g.roughnessMap.value=m.roughnessMap,e(m.roughnessMap,g.roughnessMapTransform)),m.envMap&&(g.envMapIntensity.value=m.envMapIntensity)}function f(g,m,b){g.ior.value=m.ior,m.diffuseRoughness>0&&(g.diffuseRoughness.value=m.diffuseRoughness,m.diffuseRoughnessMap&&(g.diffuseRoughnessMap.value=m.diffuseRoughnessMap,e(m.diffuseRoughnessMap,g.diffuseRoughnessMapTransform))),m.sheen>0&&(g.sheenColor.value.copy(m.sheenColor).multiplyScalar(m.sheen),g.sheenRoughness.value=m.sheenRoughness,m.sheenColorMap&&(g.sheenColorMap.value=m.sheenColorMap,e(m.sheenColorMap,g.sheenColorMapTransform)),m.sheenRoughnessMap&&(g.sheenRoughnessMap.value=m.sheenRoughnessMap,e(m.sheenRoughnessMap,g.sheenRoughnessMapTransform))),m.clearcoat>0&&(g.clearcoat.value=m.clearcoat,g.clearcoatRoughness.value=m.clearcoatRoughness,m.clearcoatMap&&(g.clearcoatMap.value=m.clearcoatMap,e(m.clearcoatMap,g.clearcoatMapTransform)),m.clearcoatRoughnessMap&&(g.clearcoatRoughnessMap.value=m.clearcoatRoughnessMap,e(m.clearcoatRoughnessMap,g.clearcoatRoughnessMapTransform)),m.clearcoatNormalMap&&(g.clearcoatNormalMap.value=m.clearcoatNormalMap,e(m.clearcoatNormalMap,g.clearcoatNormalMapTransform),g.clearcoatNormalScale.value.copy(m.clearcoatNormalScale),m.side===je&&g.clearcoatNormalScale.value.negate())),m.dispersion>0&&(g.dispersion.value=m.dispersion),m.retroreflectivity>0&&(g.retroreflectivity.value=m.retroreflectivity),m.iridescence>0&&(g.iridescence.value=m.iridescence,g.iridescenceIOR.value=m.iridescenceIOR,g.iridescenceThicknessMinimum.value=m.iridescenceThicknessMinimum,g.iridescenceThicknessMaximum.value=m.iridescenceThicknessMaximum,m.iridescenceMap&&(g.iridescenceMap.value=m.iridescenceMap,e(m.iridescenceMap,g.iridescenceMapTransform)),m.iridescenceThicknessMap&&(g.iridescenceThicknessMap.value=m.iridescenceThicknessMap,e(m.iridescenceThicknessMap,g.iridescenceThicknessMapTransform))),m.transmission>0&&(g.transmission.value=m.transmission,g.transmissionSamplerMap.value=b.texture,g.transmissionSamplerSize.value.set(b.width,b.height),m.transmissionMap&&(g.transmissionMap.value=m.transmissionMap,e(m.transmissionMap,g.transmissionMapTransform)),g.thickness.value=m.thickness,m.thicknessMap&&(g.thicknessMap.value=m.thicknessMap,e(m.thicknessMap,g.thicknessMapTransform)),g.attenuationDistance.value=m.attenuationDistance,g.attenuationColor.value.copy(m.attenuationColor)),m.anisotropy>0&&(g.anisotropyVector.value.set(m.anisotropy*Math.cos(m.anisotropyRotation),m.anisotropy*Math.sin(m.anisotropyRotation)),m.anisotropyMap&&(g.anisotropyMap.value=m.anisotropyMap,e(m.anisotropyMap,g.anisotropyMapTransform))),g.specularIntensity.value=m.specularIntensity,g.specularColor.value.copy(m.specularColor),m.specularColorMap&&(g.specularColorMap.value=m.specularColorMap,e(m.specularColorMap,g.specularColorMapTransform)),m.specularIntensityMap&&(g.specularIntensityMap.value=m.specularIntensityMap,e(m.specularIntensityMap,g.specularIntensityMapTransform))}function p(g,m){m.matcap&&(g.matcap.value=m.matcap)}function _(g,m){let b=t.get(m).light;g.referencePosition.value.setFromMatrixPosition(b.matrixWorld),g.nearDistance.value=b.shadow.camera.near,g.farDistance.value=b.shadow.camera.far}return{refreshFogUniforms:i,refreshMaterialUniforms:s}}function ov(n,t,e,i){let s={},r={};function o(b,S){let w=S.program;i.uniformBlockBinding(b,w,s[b.id])}function a(b,S){let w=s[b.id];w===void 0&&(p(b),w=l(b),s[b.id]=w,b.addEventListener("dispose",g));let E=S.program;i.updateUBOMapping(b,E);let T=t.render.frame;r[b.id]!==T&&(c(b),r[b.id]=T)}function l(b){let S=n.createBuffer(),w=b.__size,E=b.usage;return n.bindBuffer(n.UNIFORM_BUFFER,S),n.bufferData(n.UNIFORM_BUFFER,w,E),n.bindBuffer(n.UNIFORM_BUFFER,null),S}function c(b){let S=s[b.id],w=b.uniforms,E=b.__cache;n.bindBuffer(n.UNIFORM_BUFFER,S);for(let T=0,x=w.length;T<x;T++){let M=w[T];if(Array.isArray(M))for(let D=0,P=M.length;D<P;D++)h(M[D],T,D,E);else h(M,T,0,E)}n.bindBuffer(n.UNIFORM_BUFFER,null)}function h(b,S,w,E){if(d(b,S,w,E)===!0){let T=b.__offset,x=b.value;if(Array.isArray(x)){let M=0;for(let D=0;D<x.length;D++){let P=x[D],U=_(P,!0);u(P,b.__data,M),M+=U.storage/Float32Array.BYTES_PER_ELEMENT}}else u(x,b.__data,0);n.bufferSubData(n.UNIFORM_BUFFER,T,b.__data)}}function u(b,S,w){typeof b=="number"||typeof b=="boolean"?S[w]=b:b.isMatrix3?(S[w]=b.elements[0],S[w+1]=b.elements[1],S[w+2]=b.elements[2],S[w+3]=0,S[w+4]=b.elements[3],S[w+5]=b.elements[4],S[w+6]=b.elements[5],S[w+7]=0,S[w+8]=b.elements[6],S[w+9]=b.elements[7],S[w+10]=b.elements[8],S[w+11]=0):ArrayBuffer.isView(b)?S.set(b.subarray(0,S.length-w),w):b.toArray(S,w)}function d(b,S,w,E){let T=b.value,x=S+"_"+w;if(Array.isArray(T)){E[x]===void 0&&(E[x]=[]);let M=E[x],D=!1;for(let P=0;P<T.length;P++)f(T[P],M,P)===!0&&(D=!0);return D}return f(T,E,x)}function f(b,S,w){if(S[w]===void 0)return typeof b=="number"||typeof b=="boolean"?S[w]=b:ArrayBuffer.isView(b)?S[w]=b.slice():S[w]=b.clone(),!0;{let E=S[w];if(typeof b=="number"||typeof b=="boolean"){if(E!==b)return S[w]=b,!0}else{if(ArrayBuffer.isView(b))return!0;if(E.equals(b)===!1)return E.copy(b),!0}}return!1}function p(b){let S=b.uniforms,w=0,E=16;for(let x=0,M=S.length;x<M;x++){let D=Array.isArray(S[x])?S[x]:[S[x]];for(let P=0,U=D.length;P<U;P++){let F=D[P],W=Array.isArray(F.value)?F.value:[F.value],I=Array.isArray(S[x])||Array.isArray(F.value),H=w;for(let G=0,et=W.length;G<et;G++){let X=W[G],Q=_(X,I),tt=w%E,wt=tt%Q.boundary,Ot=tt+wt;w+=wt,Ot!==0&&E-Ot<Q.storage&&(w+=E-Ot),G===0&&(H=w),w+=Q.storage}let $=F.type==="int"?Int32Array:F.type==="uint"?Uint32Array:Float32Array;F.__data=new $((w-H)/Float32Array.BYTES_PER_ELEMENT),F.__offset=H}}let T=w%E;return T>0&&(w+=E-T),b.__size=w,b.__cache={},this}function _(b,S){let w={boundary:0,storage:0};return typeof b=="number"||typeof b=="boolean"?(w.boundary=4,w.storage=4):b.isVector2?(w.boundary=8,w.storage=8):b.isVector3||b.isColor?(w.boundary=16,w.storage=12):b.isVector4?(w.boundary=16,w.storage=16):b.isMatrix3?(w.boundary=16,w.storage=48):b.isMatrix4?(w.boundary=16,w.storage=64):b.isTexture?At("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(b)?(w.boundary=16,w.storage=b.byteLength):At("WebGLRenderer: Unsupported uniform value type.",b),S===!0&&(w.boundary=16,w.storage=Math.ceil(w.storage/16)*16),w}function g(b){let S=b.target;S.removeEventListener("dispose",g),n.deleteBuffer(s[S.id]),delete s[S.id],delete r[S.id]}function m(){for(let b in s)n.deleteBuffer(s[b]);s={},r={}}return{bind:o,update:a,dispose:m}}var av=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Ui=null;function lv(){return Ui===null&&(Ui=new gr(av,16,16,bn,Ti),Ui.name="DFG_LUT",Ui.minFilter=Ze,Ui.magFilter=Ze,Ui.wrapS=Li,Ui.wrapT=Li,Ui.generateMipmaps=!1,Ui.needsUpdate=!0),Ui}var rl=class{constructor(t={}){let{canvas:e=wd(),context:i=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:u=!1,reversedDepthBuffer:d=!1,outputBufferType:f=ei}=t;this.isWebGLRenderer=!0;let p;if(i!==null){if(typeof WebGLRenderingContext<"u"&&i instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=i.getContextAttributes().alpha}else p=o;let _=f,g=new Set([Sa,Ma,wa]),m=new Set([ei,Ei,Ps,Vn,ya,va]),b=new Uint32Array(4),S=new Int32Array(4),w={textures:[],min:[],max:[],resolution:[]},E=null,T=null,x=[],M=[],D=null;this.domElement=e,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Ni,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let P=this,U=!1,F=null,W=null,I=null,H=null;this._outputColorSpace=xe;let $=0,G=0,et=null,X=-1,Q=null,tt=new he,wt=new he,Ot=null,J=new Pt(0),mt=0,yt=e.width,Rt=e.height,gt=1,Bt=null,ve=null,It=new he(0,0,yt,Rt),Qt=new he(0,0,yt,Rt),ee=!1,Vt=new dn,Oe=new Yo,Se=!1,Qe=!1,fe=new $t,Ci=new N,Ce=new he,hi={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},ui=!1;function di(){return et===null?gt:1}let O=i;function fi(v,L){return e.getContext(v,L)}let le,ce,dt,Ee,Ct,Ut,A,y,k,it,j,rt,ht,Y,Z,at,C,K,q,lt,st,ot,St;try{let v={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:u};if("setAttribute"in e&&e.setAttribute("data-engine",`three.js r${"187"}`),e.addEventListener("webglcontextlost",Tt,!1),e.addEventListener("webglcontextrestored",kt,!1),e.addEventListener("webglcontextcreationerror",ft,!1),O===null){let L="webgl2";if(O=fi(L,v),O===null)throw fi(L)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}zt()}catch(v){throw e.removeEventListener("webglcontextlost",Tt,!1),e.removeEventListener("webglcontextrestored",kt,!1),e.removeEventListener("webglcontextcreationerror",ft,!1),Dt("WebGLRenderer: "+v.message),v}function zt(){le=new y_(O),le.init(),st=new ev(O,le),ce=new l_(O,le,t,st),dt=new Qy(O,le),ce.reversedDepthBuffer&&d&&dt.buffers.depth.setReversed(!0),W=O.createFramebuffer(),I=O.createFramebuffer(),H=O.createFramebuffer(),Ee=new w_(O),Ct=new ky,Ut=new tv(O,le,dt,Ct,ce,st,Ee),A=new __(P),y=new Sg(O),ot=new o_(O,y),k=new v_(O,y,Ee,ot),it=new S_(O,k,y,ot,Ee),K=new M_(O,ce,Ut),Z=new c_(Ct),j=new By(P,A,le,ce,ot,Z),rt=new rv(P,Ct),ht=new Hy,Y=new $y(le),C=new r_(P,A,dt,it,p,l),at=new jy(P,it,ce),St=new ov(O,Ee,ce,dt),q=new a_(O,le,Ee),lt=new b_(O,le,Ee),Ee.programs=j.programs,P.capabilities=ce,P.extensions=le,P.properties=Ct,P.renderLists=ht,P.shadowMap=at,P.state=dt,P.info=Ee}_!==ei&&(D=new T_(_,e.width,e.height,a,s,r));let nt=new ph(P,O);this.xr=nt,this.getContext=function(){return O},this.getContextAttributes=function(){return O.getContextAttributes()},this.forceContextLoss=function(){let v=le.get("WEBGL_lose_context");v&&v.loseContext()},this.forceContextRestore=function(){let v=le.get("WEBGL_lose_context");v&&v.restoreContext()},this.getPixelRatio=function(){return gt},this.setPixelRatio=function(v){v!==void 0&&(gt=v,this.setSize(yt,Rt,!1))},this.getSize=function(v){return v.set(yt,Rt)},this.setSize=function(v,L,V=!0){if(nt.isPresenting){At("WebGLRenderer: Can't change size while VR device is presenting.");return}yt=v,Rt=L,e.width=Math.floor(v*gt),e.height=Math.floor(L*gt),V===!0&&(e.style.width=v+"px",e.style.height=L+"px"),D!==null&&D.setSize(e.width,e.height),this.setViewport(0,0,v,L)},this.getDrawingBufferSize=function(v){return v.set(yt*gt,Rt*gt).floor()},this.setDrawingBufferSize=function(v,L,V){yt=v,Rt=L,gt=V,e.width=Math.floor(v*V),e.height=Math.floor(L*V),this.setViewport(0,0,v,L)},this.setEffects=function(v){if(_===ei){Dt("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(v){for(let L=0;L<v.length;L++)if(v[L].isOutputPass===!0){At("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}D.setEffects(v||[])},this.getCurrentViewport=function(v){return v.copy(tt)},this.getViewport=function(v){return v.copy(It)},this.setViewport=function(v,L,V,B){v.isVector4?It.set(v.x,v.y,v.z,v.w):It.set(v,L,V,B),dt.viewport(tt.copy(It).multiplyScalar(di()).round())},this.getScissor=function(v){return v.copy(Qt)},this.setScissor=function(v,L,V,B){v.isVector4?Qt.set(v.x,v.y,v.z,v.w):Qt.set(v,L,V,B),dt.scissor(wt.copy(Qt).multiplyScalar(di()).round())},this.getScissorTest=function(){return ee},this.setScissorTest=function(v){dt.setScissorTest(ee=v)},this.setOpaqueSort=function(v){Bt=v},this.setTransparentSort=function(v){ve=v},this.getClearColor=function(v){return v.copy(C.getClearColor())},this.setClearColor=function(){C.setClearColor(...arguments)},this.getClearAlpha=function(){return C.getClearAlpha()},this.setClearAlpha=function(){C.setClearAlpha(...arguments)},this.clear=function(v=!0,L=!0,V=!0){let B=0;if(v){let z=!1;if(et!==null){let ut=et.texture.format;z=g.has(ut)}if(z){let ut=et.texture.type,_t=m.has(ut),ct=C.getClearColor(),xt=C.getClearAlpha(),Mt=ct.r,Ft=ct.g,Wt=ct.b;_t?(b[0]=Mt,b[1]=Ft,b[2]=Wt,b[3]=xt,O.clearBufferuiv(O.COLOR,0,b)):(S[0]=Mt,S[1]=Ft,S[2]=Wt,S[3]=xt,O.clearBufferiv(O.COLOR,0,S))}else B|=O.COLOR_BUFFER_BIT}L&&(B|=O.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),V&&(B|=O.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),B!==0&&O.clear(B)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(v){v.setRenderer(this),F=v},this.dispose=function(){e.removeEventListener("webglcontextlost",Tt,!1),e.removeEventListener("webglcontextrestored",kt,!1),e.removeEventListener("webglcontextcreationerror",ft,!1),C.dispose(),ht.dispose(),Y.dispose(),Ut.dispose(),Ct.dispose(),A.dispose(),it.dispose(),k.dispose(),ot.dispose(),St.dispose(),j.dispose(),nt.dispose(),nt.removeEventListener("sessionstart",Bh),nt.removeEventListener("sessionend",kh),An.stop()};function Tt(v){v.preventDefault(),Zc("WebGLRenderer: Context Lost."),U=!0}function kt(){Zc("WebGLRenderer: Context Restored."),U=!1;let v=Ee.autoReset,L=at.enabled,V=at.autoUpdate,B=at.needsUpdate,z=at.type;zt(),Ee.autoReset=v,at.enabled=L,at.autoUpdate=V,at.needsUpdate=B,at.type=z}function ft(v){Dt("WebGLRenderer: A WebGL context could not be created. Reason: ",v.statusMessage)}function te(v){let L=v.target;L.removeEventListener("dispose",te),Pe(L)}function Pe(v){tn(v),Ct.remove(v)}function tn(v){let L=Ct.get(v).programs;L!==void 0&&(L.forEach(function(V){j.releaseProgram(V)}),v.isShaderMaterial&&j.releaseShaderCache(v))}this.renderBufferDirect=function(v,L,V,B,z,ut){L===null&&(L=hi);let _t=z.isMesh&&z.matrixWorld.determinantAffine()<0,ct=Jp(v,L,V,B,z);dt.setMaterial(B,_t);let xt=V.index,Mt=1;if(B.wireframe===!0){if(xt=k.getWireframeAttribute(V),xt===void 0)return;Mt=2}let Ft=V.drawRange,Wt=V.attributes.position,vt=Ft.start*Mt,Xt=(Ft.start+Ft.count)*Mt;ut!==null&&(vt=Math.max(vt,ut.start*Mt),Xt=Math.min(Xt,(ut.start+ut.count)*Mt)),xt!==null?(vt=Math.max(vt,0),Xt=Math.min(Xt,xt.count)):Wt!=null&&(vt=Math.max(vt,0),Xt=Math.min(Xt,Wt.count));let be=Xt-vt;if(be<0||be===1/0)return;ot.setup(z,B,ct,V,xt);let se,ie=q;if(xt!==null&&(se=y.get(xt),ie=lt,ie.setIndex(se)),z.isMesh)B.wireframe===!0?(dt.setLineWidth(B.wireframeLinewidth*di()),ie.setMode(O.LINES)):ie.setMode(O.TRIANGLES);else if(z.isLine){let He=B.linewidth;He===void 0&&(He=1),dt.setLineWidth(He*di()),z.isLineSegments?ie.setMode(O.LINES):z.isLineLoop?ie.setMode(O.LINE_LOOP):ie.setMode(O.LINE_STRIP)}else z.isPoints?ie.setMode(O.POINTS):z.isSprite&&ie.setMode(O.TRIANGLES);if(z.isBatchedMesh)if(le.get("WEBGL_multi_draw"))ie.renderMultiDraw(z._multiDrawStarts,z._multiDrawCounts,z._multiDrawCount);else{let He=z._multiDrawStarts,bt=z._multiDrawCounts,$e=z._multiDrawCount,Zt=xt?y.get(xt).bytesPerElement:1,Rn=Ct.get(B).currentProgram.getUniforms();for(let Ge=0;Ge<$e;Ge++)Rn.setValue(O,"_gl_DrawID",Ge),ie.render(He[Ge]/Zt,bt[Ge])}else if(z.isInstancedMesh)ie.renderInstances(vt,be,z.count);else if(V.isInstancedBufferGeometry){let He=V._maxInstanceCount!==void 0?V._maxInstanceCount:1/0,bt=Math.min(V.instanceCount,He);ie.renderInstances(vt,be,bt)}else ie.render(vt,be)};function Fh(v,L,V,B){F!==null&&v.isNodeMaterial&&F.setObject(B,v),Se===!0&&Z.setState(v,V,!1),v.transparent===!0&&v.side===Me&&v.forceSinglePass===!1?(v.side=je,v.needsUpdate=!0,Hs(v,L,B),v.side=vn,v.needsUpdate=!0,Hs(v,L,B),v.side=Me):Hs(v,L,B)}this.compile=function(v,L,V=null){V===null&&(V=v),F!==null&&F.renderStart(v,L,V),T=Y.get(V),T.init(L),M.push(T),V.traverseVisible(function(z){z.isLight&&z.layers.test(L.layers)&&(T.pushLight(z),z.castShadow&&T.pushShadow(z))}),v!==V&&v.traverseVisible(function(z){z.isLight&&z.layers.test(L.layers)&&(T.pushLight(z),z.castShadow&&T.pushShadow(z))}),T.setupLights(),F!==null&&F.updateLights(T.state.lightsArray),Qe=this.localClippingEnabled,Se=Z.init(this.clippingPlanes,Qe),Se===!0&&Z.setGlobalState(this.clippingPlanes,L),F!==null&&at.render(T.state.shadowsArray,V,L);let B=new Set;return v.traverse(function(z){if(!(z.isMesh||z.isPoints||z.isLine||z.isSprite))return;let ut=z.material;if(ut)if(Array.isArray(ut))for(let _t=0;_t<ut.length;_t++){let ct=ut[_t];Fh(ct,V,L,z),B.add(ct)}else Fh(ut,V,L,z),B.add(ut)}),T=M.pop(),F!==null&&F.renderEnd(),B},this.compileAsync=function(v,L,V=null){let B=this.compile(v,L,V);return new Promise(z=>{function ut(){if(B.forEach(function(_t){let xt=Ct.get(_t).currentProgram;(xt===void 0||xt.isReady())&&B.delete(_t)}),B.size===0){z(v);return}setTimeout(ut,10)}le.get("KHR_parallel_shader_compile")!==null?ut():setTimeout(ut,10)})};let Vl=null;function Yp(v){Vl&&Vl(v)}function Bh(){An.stop()}function kh(){An.start()}let An=new Qd;An.setAnimationLoop(Yp),typeof self<"u"&&An.setContext(self),this.setAnimationLoop=function(v){Vl=v,nt.setAnimationLoop(v),v===null?An.stop():An.start()},nt.addEventListener("sessionstart",Bh),nt.addEventListener("sessionend",kh),this.render=function(v,L){if(L!==void 0&&L.isCamera!==!0){Dt("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(U===!0)return;F!==null&&F.renderStart(v,L);let V=nt.enabled===!0&&nt.isPresenting===!0,B=D!==null&&(et===null||V)&&D.begin(P,et);if(v.matrixWorldAutoUpdate===!0&&v.updateMatrixWorld(),L.parent===null&&L.matrixWorldAutoUpdate===!0&&L.updateMatrixWorld(),nt.enabled===!0&&nt.isPresenting===!0&&(D===null||D.isCompositing()===!1)&&(nt.cameraAutoUpdate===!0&&nt.updateCamera(L),L=nt.getCamera()),v.isScene===!0&&v.onBeforeRender(P,v,L,et),T=Y.get(v,M.length),T.init(L),T.state.textureUnits=Ut.getTextureUnits(),M.push(T),fe.multiplyMatrices(L.projectionMatrix,L.matrixWorldInverse),L.isArrayCamera?Oe.setFromArrayCamera(L):Vt.setFromProjectionMatrix(fe,gi,L.reversedDepth),Qe=this.localClippingEnabled,Se=Z.init(this.clippingPlanes,Qe),E=ht.get(v,x.length),E.init(),x.push(E),this.info.render.frame++,nt.enabled===!0&&nt.isPresenting===!0){let _t=P.xr.getDepthSensingMesh();_t!==null&&Wl(_t,L,-1/0,P.sortObjects)}Wl(v,L,0,P.sortObjects),E.finish(),F!==null&&F.updateLights(T.state.lightsArray),P.sortObjects===!0&&E.sort(Bt,ve),ui=nt.enabled===!1||nt.isPresenting===!1||nt.hasDepthSensing()===!1,ui&&C.addToRenderList(E,v),this.info.autoReset===!0&&this.info.reset(),Se===!0&&Z.beginShadows();let z=T.state.shadowsArray;if(at.render(z,v,L),Se===!0&&Z.endShadows(),(B&&D.hasRenderPass())===!1){let _t=E.opaque,ct=E.transmissive;if(T.setupLights(),L.isArrayCamera){let xt=L.cameras;if(ct.length>0)for(let Mt=0,Ft=xt.length;Mt<Ft;Mt++){let Wt=xt[Mt];Hh(_t,ct,v,Wt)}ui&&C.render(v);for(let Mt=0,Ft=xt.length;Mt<Ft;Mt++){let Wt=xt[Mt];zh(E,v,Wt,Wt.viewport)}}else ct.length>0&&Hh(_t,ct,v,L),ui&&C.render(v),zh(E,v,L)}et!==null&&G===0&&(Ut.updateMultisampleRenderTarget(et),Ut.updateRenderTargetMipmap(et)),B&&D.end(P),v.isScene===!0&&v.onAfterRender(P,v,L),ot.resetDefaultState(),X=-1,Q=null,M.pop(),M.length>0?(T=M[M.length-1],Ut.setTextureUnits(T.state.textureUnits),Se===!0&&Z.setGlobalState(P.clippingPlanes,T.state.camera)):T=null,x.pop(),x.length>0?E=x[x.length-1]:E=null,F!==null&&F.renderEnd()};function Wl(v,L,V,B){if(v.visible===!1)return;if(v.layers.test(L.layers)){if(v.isGroup)V=v.renderOrder;else if(v.isLOD)v.autoUpdate===!0&&v.update(L);else if(v.isLight)T.pushLight(v),v.castShadow&&T.pushShadow(v);else if(v.isSprite){let _t=L.isArrayCamera?Oe:Vt;if(!v.frustumCulled||v.intersectsFrustum(_t)){B&&Ce.setFromMatrixPosition(v.matrixWorld).applyMatrix4(fe);let ct=it.update(v),xt=v.material;xt.visible&&E.push(v,ct,xt,V,Ce.z,null,L)}}else if(v.isMesh||v.isLine||v.isPoints){let _t=L.isArrayCamera?Oe:Vt;if(!v.frustumCulled||v.intersectsFrustum(_t)){let ct=it.update(v),xt=v.material;if(B&&(v.boundingSphere!==void 0?(v.boundingSphere===null&&v.computeBoundingSphere(),Ce.copy(v.boundingSphere.center)):(ct.boundingSphere===null&&ct.computeBoundingSphere(),Ce.copy(ct.boundingSphere.center)),Ce.applyMatrix4(v.matrixWorld).applyMatrix4(fe)),Array.isArray(xt)){let Mt=ct.groups;for(let Ft=0,Wt=Mt.length;Ft<Wt;Ft++){let vt=Mt[Ft],Xt=xt[vt.materialIndex];Xt&&Xt.visible&&E.push(v,ct,Xt,V,Ce.z,vt,L)}}else xt.visible&&E.push(v,ct,xt,V,Ce.z,null,L)}}}let ut=v.children;for(let _t=0,ct=ut.length;_t<ct;_t++)Wl(ut[_t],L,V,B)}function zh(v,L,V,B){let{opaque:z,transmissive:ut,transparent:_t}=v;T.setupLightsView(V),Se===!0&&Z.setGlobalState(P.clippingPlanes,V),B&&dt.viewport(tt.copy(B)),z.length>0&&Zr(z,L,V),ut.length>0&&Zr(ut,L,V),_t.length>0&&Zr(_t,L,V),dt.buffers.depth.setTest(!0),dt.buffers.depth.setMask(!0),dt.buffers.color.setMask(!0),dt.setPolygonOffset(!1)}function Hh(v,L,V,B){if((V.isScene===!0?V.overrideMaterial:null)!==null)return;if(T.state.transmissionRenderTarget[B.id]===void 0){let vt=le.has("EXT_color_buffer_half_float")||le.has("EXT_color_buffer_float");T.state.transmissionRenderTarget[B.id]=new Ke(1,1,{generateMipmaps:!0,type:vt?Ti:ei,minFilter:Ji,samples:Math.max(4,ce.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:qt.workingColorSpace})}let ut=T.state.transmissionRenderTarget[B.id],_t=B.viewport||tt;ut.setSize(_t.z*P.transmissionResolutionScale,_t.w*P.transmissionResolutionScale);let ct=P.getRenderTarget(),xt=P.getActiveCubeFace(),Mt=P.getActiveMipmapLevel();P.setRenderTarget(ut),P.getClearColor(J),mt=P.getClearAlpha(),mt<1&&P.setClearColor(16777215,.5),P.clear(),ui&&C.render(V);let Ft=P.toneMapping;P.toneMapping=Ni;let Wt=B.viewport;if(B.viewport!==void 0&&(B.viewport=void 0),T.setupLightsView(B),Se===!0&&Z.setGlobalState(P.clippingPlanes,B),Zr(v,V,B),Ut.updateMultisampleRenderTarget(ut),Ut.updateRenderTargetMipmap(ut),le.has("WEBGL_multisampled_render_to_texture")===!1){let vt=!1;for(let Xt=0,be=L.length;Xt<be;Xt++){let se=L[Xt],{object:ie,geometry:He,material:bt,group:$e}=se;if(bt.side===Me&&ie.layers.test(B.layers)){let Zt=bt.side;bt.side=je,bt.needsUpdate=!0,Gh(ie,V,B,He,bt,$e),bt.side=Zt,bt.needsUpdate=!0,vt=!0}}vt===!0&&(Ut.updateMultisampleRenderTarget(ut),Ut.updateRenderTargetMipmap(ut))}P.setRenderTarget(ct,xt,Mt),P.setClearColor(J,mt),Wt!==void 0&&(B.viewport=Wt),P.toneMapping=Ft}function Zr(v,L,V){let B=L.isScene===!0?L.overrideMaterial:null;for(let z=0,ut=v.length;z<ut;z++){let _t=v[z],{object:ct,geometry:xt,group:Mt}=_t,Ft=_t.material;Ft.allowOverride===!0&&B!==null&&(Ft=B),ct.layers.test(V.layers)&&Gh(ct,L,V,xt,Ft,Mt)}}function Gh(v,L,V,B,z,ut){F!==null&&z.isNodeMaterial&&F.setObject(v,z),v.onBeforeRender(P,L,V,B,z,ut),v.modelViewMatrix.multiplyMatrices(V.matrixWorldInverse,v.matrixWorld),v.normalMatrix.getNormalMatrix(v.modelViewMatrix),z.onBeforeRender(P,L,V,B,v,ut),z.transparent===!0&&z.side===Me&&z.forceSinglePass===!1?(z.side=je,z.needsUpdate=!0,P.renderBufferDirect(V,L,B,z,v,ut),z.side=vn,z.needsUpdate=!0,P.renderBufferDirect(V,L,B,z,v,ut),z.side=Me):P.renderBufferDirect(V,L,B,z,v,ut),v.onAfterRender(P,L,V,B,z,ut)}function Vh(v){let L=0;for(let V of v)V.texture!==null&&L++;return L}function Hs(v,L,V){L.isScene!==!0&&(L=hi);let B=Ct.get(v),z=T.state.lights,ut=T.state.shadowsArray,_t=z.state.version,ct=j.getParameters(v,z.state,ut,L,V,T.state.lightProbeGridArray),xt=j.getProgramCacheKey(ct),Mt=B.programs;B.environment=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?L.environment:null,B.fog=L.fog;let Ft=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap;B.envMap=A.get(v.envMap||B.environment,Ft),B.envMapRotation=B.environment!==null&&v.envMap===null?L.environmentRotation:v.envMapRotation,Mt===void 0&&(v.addEventListener("dispose",te),Mt=new Map,B.programs=Mt,B.programVariants=new Map);let Wt=Mt.get(xt);if(Wt!==void 0){if(B.currentProgram===Wt&&B.lightsStateVersion===_t)return Xh(v,ct),Wt}else ct.uniforms=j.getUniforms(v),F!==null&&v.isNodeMaterial&&F.build(v,V,ct),v.onBeforeCompile(ct,P),Wt=j.acquireProgram(ct,xt),Mt.set(xt,Wt),B.uniforms=ct.uniforms;let vt=B.uniforms;return(!v.isShaderMaterial&&!v.isRawShaderMaterial||v.clipping===!0)&&(vt.clippingPlanes=Z.uniform),Xh(v,ct),B.needsLights=jp(v),B.lightsStateVersion=_t,B.needsLights&&(vt.ambientLightColor.value=z.state.ambient,vt.lightProbe.value=z.state.probe,vt.sunLights.value=z.state.sun,vt.sunLightShadows.value=z.state.sunShadow,vt.directionalLights.value=z.state.directional,vt.directionalLightShadows.value=z.state.directionalShadow,vt.spotLights.value=z.state.spot,vt.spotLightShadows.value=z.state.spotShadow,vt.rectAreaLights.value=z.state.rectArea,vt.ltc_1.value=z.state.rectAreaLTC1,vt.ltc_2.value=z.state.rectAreaLTC2,vt.pointLights.value=z.state.point,vt.pointLightShadows.value=z.state.pointShadow,vt.hemisphereLights.value=z.state.hemi,vt.sunShadowMatrix.value=z.state.sunShadowMatrix,vt.sunShadowCascade.value=z.state.sunShadowCascade,vt.directionalShadowMatrix.value=z.state.directionalShadowMatrix,vt.spotLightMatrix.value=z.state.spotLightMatrix,vt.spotLightMap.value=z.state.spotLightMap,vt.pointShadowMatrix.value=z.state.pointShadowMatrix),B.numLightProbeGrids=Vh(T.state.lightProbeGridArray),B.currentProgram=Wt,B.uniformsList=null,Wt}function Zp(v,L,V,B,z){let ut=Ct.get(v),_t=ut.currentProgram.id+","+B+","+z,ct=ut.programVariants.get(_t);return ct===void 0?(ct=Hs(v,L,V),ut.programVariants.set(_t,ct)):(ut.currentProgram=ct,ut.uniformsList=null,ut.outputColorSpace=B,ut.toneMapping=z),ct}function Wh(v){if(v.uniformsList===null){let L=v.currentProgram.getUniforms();v.uniformsList=Ls.seqWithValue(L.seq,v.uniforms)}return v.uniformsList}function Xh(v,L){let V=Ct.get(v);V.outputColorSpace=L.outputColorSpace,V.batching=L.batching,V.batchingColor=L.batchingColor,V.instancing=L.instancing,V.instancingColor=L.instancingColor,V.instancingMorph=L.instancingMorph,V.skinning=L.skinning,V.morphTargets=L.morphTargets,V.morphNormals=L.morphNormals,V.morphColors=L.morphColors,V.morphTargetsCount=L.morphTargetsCount,V.numClippingPlanes=L.numClippingPlanes,V.numIntersection=L.numClipIntersection,V.vertexAlphas=L.vertexAlphas,V.vertexTangents=L.vertexTangents,V.toneMapping=L.toneMapping}function Jp(v,L,V,B,z){L.isScene!==!0&&(L=hi),Ut.resetTextureUnits();let ut=L.fog,_t=B.isMeshStandardMaterial||B.isMeshLambertMaterial||B.isMeshPhongMaterial?L.environment:null,ct=et===null?P.outputColorSpace:et.isXRRenderTarget===!0?et.texture.colorSpace:qt.workingColorSpace,xt=B.isMeshStandardMaterial||B.isMeshLambertMaterial&&!B.envMap||B.isMeshPhongMaterial&&!B.envMap,Mt=A.get(B.envMap||_t,xt),Ft=B.vertexColors===!0&&!!V.attributes.color&&V.attributes.color.itemSize===4,Wt=!!V.attributes.tangent&&(!!B.normalMap||B.anisotropy>0),vt=!!V.morphAttributes.position,Xt=!!V.morphAttributes.normal,be=!!V.morphAttributes.color,se=Ni;B.toneMapped&&(et===null||et.isXRRenderTarget===!0)&&(se=P.toneMapping);let ie=V.morphAttributes.position||V.morphAttributes.normal||V.morphAttributes.color,He=ie!==void 0?ie.length:0,bt=Ct.get(B),$e=T.state.lights;if(Se===!0&&(Qe===!0||v!==Q)){let pe=v===Q&&B.id===X;Z.setState(B,v,pe)}let Zt=!1,Rn=!1;B.version===bt.__version?bt.needsLights&&bt.lightsStateVersion!==$e.state.version||z.isBatchedMesh&&bt.batching===!1||!z.isBatchedMesh&&bt.batching===!0||z.isBatchedMesh&&bt.batchingColor===!0&&z._colorsTexture===null||z.isBatchedMesh&&bt.batchingColor===!1&&z._colorsTexture!==null||z.isInstancedMesh&&bt.instancing===!1||!z.isInstancedMesh&&bt.instancing===!0||z.isSkinnedMesh&&bt.skinning===!1||!z.isSkinnedMesh&&bt.skinning===!0||z.isInstancedMesh&&bt.instancingColor===!0&&z.instanceColor===null||z.isInstancedMesh&&bt.instancingColor===!1&&z.instanceColor!==null||z.isInstancedMesh&&bt.instancingMorph===!0&&z.morphTexture===null||z.isInstancedMesh&&bt.instancingMorph===!1&&z.morphTexture!==null||bt.envMap!==Mt||B.fog===!0&&bt.fog!==ut||bt.numClippingPlanes!==void 0&&(bt.numClippingPlanes!==Z.numPlanes||bt.numIntersection!==Z.numIntersection)||bt.vertexAlphas!==Ft||bt.vertexTangents!==Wt||bt.morphTargets!==vt||bt.morphNormals!==Xt||bt.morphColors!==be||bt.morphTargetsCount!==He||bt.numLightProbeGrids!==Vh(T.state.lightProbeGridArray)?Zt=!0:(bt.outputColorSpace!==ct||bt.toneMapping!==se)&&(Rn=!0):(Zt=!0,bt.__version=B.version);let Ge=bt.currentProgram;(Zt===!0||Rn===!0)&&(Ge=Rn===!0?Zp(B,L,z,ct,se):Hs(B,L,z),F&&B.isNodeMaterial&&F.onUpdateProgram(B,Ge,bt));let Jr=!1,en=!1,Cn=!1,Yt=Ge.getUniforms(),Fe=bt.uniforms;if(dt.useProgram(Ge.program)&&(Jr=!0,en=!0,Cn=!0),B.id!==X&&(X=B.id,en=!0),Jr||Q!==v){dt.buffers.depth.getReversed()&&v.reversedDepth!==!0&&(v._reversedDepth=!0,v.updateProjectionMatrix()),Yt.setValue(O,"projectionMatrix",v.projectionMatrix),Yt.setValue(O,"viewMatrix",v.matrixWorldInverse);let Ie=Yt.map.cameraPosition;Ie!==void 0&&Ie.setValue(O,Ci.setFromMatrixPosition(v.matrixWorld)),ce.logarithmicDepthBuffer&&Yt.setValue(O,"logDepthBufFC",2/(Math.log(v.far+1)/Math.LN2)),(B.isMeshPhongMaterial||B.isMeshToonMaterial||B.isMeshLambertMaterial||B.isMeshBasicMaterial||B.isMeshStandardMaterial||B.isShaderMaterial)&&Yt.setValue(O,"isOrthographic",v.isOrthographicCamera===!0),Q!==v&&(Q=v,en=!0,Cn=!0)}if(bt.needsLights&&($e.state.sunShadowMap.length>0&&Yt.setValue(O,"sunShadowMap",$e.state.sunShadowMap,Ut),$e.state.directionalShadowMap.length>0&&Yt.setValue(O,"directionalShadowMap",$e.state.directionalShadowMap,Ut),$e.state.spotShadowMap.length>0&&Yt.setValue(O,"spotShadowMap",$e.state.spotShadowMap,Ut),$e.state.pointShadowMap.length>0&&Yt.setValue(O,"pointShadowMap",$e.state.pointShadowMap,Ut)),z.isSkinnedMesh){Yt.setOptional(O,z,"bindMatrix"),Yt.setOptional(O,z,"bindMatrixInverse");let pe=z.skeleton;pe&&(pe.boneTexture===null&&pe.computeBoneTexture(),Yt.setValue(O,"boneTexture",pe.boneTexture,Ut))}z.isBatchedMesh&&(Yt.setOptional(O,z,"batchingTexture"),Yt.setValue(O,"batchingTexture",z._matricesTexture,Ut),Yt.setOptional(O,z,"batchingIdTexture"),Yt.setValue(O,"batchingIdTexture",z._indirectTexture,Ut),Yt.setOptional(O,z,"batchingColorTexture"),z._colorsTexture!==null&&Yt.setValue(O,"batchingColorTexture",z._colorsTexture,Ut));let vi=V.morphAttributes;if((vi.position!==void 0||vi.normal!==void 0||vi.color!==void 0)&&K.update(z,V,Ge),(en||bt.receiveShadow!==z.receiveShadow)&&(bt.receiveShadow=z.receiveShadow,Yt.setValue(O,"receiveShadow",z.receiveShadow)),(B.isMeshStandardMaterial||B.isMeshLambertMaterial||B.isMeshPhongMaterial)&&B.envMap===null&&L.environment!==null&&(Fe.envMapIntensity.value=L.environmentIntensity),Fe.dfgLUT!==void 0&&(Fe.dfgLUT.value=lv()),en){if(Yt.setValue(O,"toneMappingExposure",P.toneMappingExposure),bt.needsLights&&Kp(Fe,Cn),ut&&B.fog===!0&&rt.refreshFogUniforms(Fe,ut),rt.refreshMaterialUniforms(Fe,B,gt,Rt,T.state.transmissionRenderTarget[v.id]),bt.needsLights&&bt.numLightProbeGrids>0){let pe=w,Ie=0;for(let Fi of T.state.lightProbeGridArray)Fi.texture!==null&&(pe.textures[Ie]=Fi.texture,pe.min[Ie]=Fi.boundingBox.min,pe.max[Ie]=Fi.boundingBox.max,pe.resolution[Ie]=Fi.resolution,Ie++);for(let Fi in pe)pe[Fi].length=Ie;Fe.probesSH.value=pe.textures,Fe.probesMin.value=pe.min,Fe.probesMax.value=pe.max,Fe.probesResolution.value=pe.resolution}Ls.upload(O,Wh(bt),Fe,Ut)}if(B.isShaderMaterial&&B.uniformsNeedUpdate===!0&&(Ls.upload(O,Wh(bt),Fe,Ut),B.uniformsNeedUpdate=!1),B.isSpriteMaterial&&Yt.setValue(O,"center",z.center),Yt.setValue(O,"modelViewMatrix",z.modelViewMatrix),Yt.setValue(O,"normalMatrix",z.normalMatrix),Yt.setValue(O,"modelMatrix",z.matrixWorld),B.uniformsGroups!==void 0){let pe=B.uniformsGroups;for(let Ie=0,Fi=pe.length;Ie<Fi;Ie++){let $h=pe[Ie];St.update($h,Ge),St.bind($h,Ge)}}return Ge}function Kp(v,L){v.ambientLightColor.needsUpdate=L,v.lightProbe.needsUpdate=L,v.sunLights.needsUpdate=L,v.sunLightShadows.needsUpdate=L,v.directionalLights.needsUpdate=L,v.directionalLightShadows.needsUpdate=L,v.pointLights.needsUpdate=L,v.pointLightShadows.needsUpdate=L,v.spotLights.needsUpdate=L,v.spotLightShadows.needsUpdate=L,v.rectAreaLights.needsUpdate=L,v.hemisphereLights.needsUpdate=L}function jp(v){return v.isMeshLambertMaterial||v.isMeshToonMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isShadowMaterial||v.isShaderMaterial&&v.lights===!0}this.getActiveCubeFace=function(){return $},this.getActiveMipmapLevel=function(){return G},this.getRenderTarget=function(){return et},this.setRenderTargetTextures=function(v,L,V){let B=Ct.get(v);B.__autoAllocateDepthBuffer=v.resolveDepthBuffer===!1,B.__autoAllocateDepthBuffer===!1&&(B.__useRenderToTexture=!1),Ct.get(v.texture).__webglTexture=L,Ct.get(v.depthTexture).__webglTexture=B.__autoAllocateDepthBuffer?void 0:V,B.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(v,L){let V=Ct.get(v);V.__webglFramebuffer=L,V.__useDefaultFramebuffer=L===void 0},this.setRenderTarget=function(v,L=0,V=0){et=v,$=L,G=V;let B=null,z=!1,ut=!1;if(v){let ct=Ct.get(v);if(ct.__useDefaultFramebuffer!==void 0){dt.bindFramebuffer(O.FRAMEBUFFER,ct.__webglFramebuffer),tt.copy(v.viewport),wt.copy(v.scissor),Ot=v.scissorTest,dt.viewport(tt),dt.scissor(wt),dt.setScissorTest(Ot),X=-1;return}else if(ct.__webglFramebuffer===void 0)Ut.setupRenderTarget(v);else if(ct.__hasExternalTextures)Ut.rebindTextures(v,Ct.get(v.texture).__webglTexture,Ct.get(v.depthTexture).__webglTexture);else if(v.depthBuffer){let Ft=v.depthTexture;if(ct.__boundDepthTexture!==Ft){if(Ft!==null&&Ct.has(Ft)&&(v.width!==Ft.image.width||v.height!==Ft.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");Ut.setupDepthRenderbuffer(v)}}let xt=v.texture;(xt.isData3DTexture||xt.isDataArrayTexture||xt.isCompressedArrayTexture)&&(ut=!0);let Mt=Ct.get(v).__webglFramebuffer;v.isWebGLCubeRenderTarget?(Array.isArray(Mt[L])?B=Mt[L][V]:B=Mt[L],z=!0):v.samples>0&&Ut.useMultisampledRTT(v)===!1?B=Ct.get(v).__webglMultisampledFramebuffer:Array.isArray(Mt)?B=Mt[V]:B=Mt,tt.copy(v.viewport),wt.copy(v.scissor),Ot=v.scissorTest}else tt.copy(It).multiplyScalar(gt).floor(),wt.copy(Qt).multiplyScalar(gt).floor(),Ot=ee;if(V!==0&&(B=W),dt.bindFramebuffer(O.FRAMEBUFFER,B)&&dt.drawBuffers(v,B),dt.viewport(tt),dt.scissor(wt),dt.setScissorTest(Ot),z){let ct=Ct.get(v.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_CUBE_MAP_POSITIVE_X+L,ct.__webglTexture,V)}else if(ut){let ct=L;for(let xt=0;xt<v.textures.length;xt++){let Mt=Ct.get(v.textures[xt]);O.framebufferTextureLayer(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0+xt,Mt.__webglTexture,V,ct)}}else if(v!==null&&V!==0){let ct=Ct.get(v.texture);O.framebufferTexture2D(O.FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,ct.__webglTexture,V)}X=-1};function qh(v){let L=Ct.get(v);return(L.__readFormat!==v.format||L.__readType!==v.type)&&(L.__readFormat=v.format,L.__readType=v.type,L.__formatReadable=ce.textureFormatReadable(v.format),L.__typeReadable=ce.textureTypeReadable(v.type)),L}this.readRenderTargetPixels=function(v,L,V,B,z,ut,_t,ct=0){if(!(v&&v.isWebGLRenderTarget)){Dt("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let xt=Ct.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&_t!==void 0&&(xt=xt[_t],Array.isArray(xt)&&(xt=xt[0])),xt){dt.bindFramebuffer(O.FRAMEBUFFER,xt);try{let Mt=v.textures[ct],Ft=Mt.format,Wt=Mt.type;v.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+ct);let vt=qh(Mt);if(vt.__formatReadable===!1){Dt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(vt.__typeReadable===!1){Dt("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}L>=0&&L<=v.width-B&&V>=0&&V<=v.height-z&&O.readPixels(L,V,B,z,st.convert(Ft),st.convert(Wt),ut)}finally{let Mt=et!==null?Ct.get(et).__webglFramebuffer:null;dt.bindFramebuffer(O.FRAMEBUFFER,Mt)}}},this.readRenderTargetPixelsAsync=async function(v,L,V,B,z,ut,_t,ct=0){if(!(v&&v.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let xt=Ct.get(v).__webglFramebuffer;if(v.isWebGLCubeRenderTarget&&_t!==void 0&&(xt=xt[_t],Array.isArray(xt)&&(xt=xt[0])),xt)if(L>=0&&L<=v.width-B&&V>=0&&V<=v.height-z){dt.bindFramebuffer(O.FRAMEBUFFER,xt);let Mt=v.textures[ct],Ft=Mt.format,Wt=Mt.type;v.textures.length>1&&O.readBuffer(O.COLOR_ATTACHMENT0+ct);let vt=qh(Mt);if(vt.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(vt.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Xt=O.createBuffer();O.bindBuffer(O.PIXEL_PACK_BUFFER,Xt),O.bufferData(O.PIXEL_PACK_BUFFER,ut.byteLength,O.STREAM_READ),O.readPixels(L,V,B,z,st.convert(Ft),st.convert(Wt),0),O.bindBuffer(O.PIXEL_PACK_BUFFER,null);let be=et!==null?Ct.get(et).__webglFramebuffer:null;dt.bindFramebuffer(O.FRAMEBUFFER,be);let se=O.fenceSync(O.SYNC_GPU_COMMANDS_COMPLETE,0);return O.flush(),await Sd(O,se,4),O.bindBuffer(O.PIXEL_PACK_BUFFER,Xt),O.getBufferSubData(O.PIXEL_PACK_BUFFER,0,ut),O.bindBuffer(O.PIXEL_PACK_BUFFER,null),O.deleteBuffer(Xt),O.deleteSync(se),ut}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(v,L=null,V=0){let B=Math.pow(2,-V),z=Math.floor(v.image.width*B),ut=Math.floor(v.image.height*B),_t=L!==null?L.x:0,ct=L!==null?L.y:0;Ut.setTexture2D(v,0),O.copyTexSubImage2D(O.TEXTURE_2D,V,0,0,_t,ct,z,ut),dt.unbindTexture()},this.copyTextureToTexture=function(v,L,V=null,B=null,z=0,ut=0){let _t,ct,xt,Mt,Ft,Wt,vt,Xt,be,se=v.isCompressedTexture?v.mipmaps[ut]:v.image;if(V!==null)_t=V.max.x-V.min.x,ct=V.max.y-V.min.y,xt=V.isBox3?V.max.z-V.min.z:1,Mt=V.min.x,Ft=V.min.y,Wt=V.isBox3?V.min.z:0;else{let Yt=Math.pow(2,-z);_t=Math.floor(se.width*Yt),ct=Math.floor(se.height*Yt),v.isDataArrayTexture?xt=se.depth:v.isData3DTexture?xt=Math.floor(se.depth*Yt):xt=1,Mt=0,Ft=0,Wt=0}B!==null?(vt=B.x,Xt=B.y,be=B.z):(vt=0,Xt=0,be=0);let ie=st.convert(L.format),He=st.convert(L.type),bt;L.isData3DTexture?(Ut.setTexture3D(L,0),bt=O.TEXTURE_3D):L.isDataArrayTexture||L.isCompressedArrayTexture?(Ut.setTexture2DArray(L,0),bt=O.TEXTURE_2D_ARRAY):(Ut.setTexture2D(L,0),bt=O.TEXTURE_2D),dt.activeTexture(O.TEXTURE0),dt.pixelStorei(O.UNPACK_FLIP_Y_WEBGL,L.flipY),dt.pixelStorei(O.UNPACK_PREMULTIPLY_ALPHA_WEBGL,L.premultiplyAlpha),dt.pixelStorei(O.UNPACK_ALIGNMENT,L.unpackAlignment);let $e=dt.getParameter(O.UNPACK_ROW_LENGTH),Zt=dt.getParameter(O.UNPACK_IMAGE_HEIGHT),Rn=dt.getParameter(O.UNPACK_SKIP_PIXELS),Ge=dt.getParameter(O.UNPACK_SKIP_ROWS),Jr=dt.getParameter(O.UNPACK_SKIP_IMAGES);dt.pixelStorei(O.UNPACK_ROW_LENGTH,se.width),dt.pixelStorei(O.UNPACK_IMAGE_HEIGHT,se.height),dt.pixelStorei(O.UNPACK_SKIP_PIXELS,Mt),dt.pixelStorei(O.UNPACK_SKIP_ROWS,Ft),dt.pixelStorei(O.UNPACK_SKIP_IMAGES,Wt);let en=v.isDataArrayTexture||v.isData3DTexture,Cn=L.isDataArrayTexture||L.isData3DTexture;if(v.isDepthTexture){let Yt=Ct.get(v),Fe=Ct.get(L),vi=Ct.get(Yt.__renderTarget),pe=Ct.get(Fe.__renderTarget);dt.bindFramebuffer(O.READ_FRAMEBUFFER,vi.__webglFramebuffer),dt.bindFramebuffer(O.DRAW_FRAMEBUFFER,pe.__webglFramebuffer);for(let Ie=0;Ie<xt;Ie++)en&&(O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Ct.get(v).__webglTexture,z,Wt+Ie),O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Ct.get(L).__webglTexture,ut,be+Ie)),O.blitFramebuffer(Mt,Ft,Mt+_t,Ft+ct,vt,Xt,vt+_t,Xt+ct,O.DEPTH_BUFFER_BIT,O.NEAREST);dt.bindFramebuffer(O.READ_FRAMEBUFFER,null),dt.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else if(z!==0||v.isRenderTargetTexture||Ct.has(v)){let Yt=Ct.get(v),Fe=Ct.get(L);dt.bindFramebuffer(O.READ_FRAMEBUFFER,I),dt.bindFramebuffer(O.DRAW_FRAMEBUFFER,H);for(let vi=0;vi<xt;vi++)en?O.framebufferTextureLayer(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Yt.__webglTexture,z,Wt+vi):O.framebufferTexture2D(O.READ_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Yt.__webglTexture,z),Cn?O.framebufferTextureLayer(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,Fe.__webglTexture,ut,be+vi):O.framebufferTexture2D(O.DRAW_FRAMEBUFFER,O.COLOR_ATTACHMENT0,O.TEXTURE_2D,Fe.__webglTexture,ut),z!==0?O.blitFramebuffer(Mt,Ft,Mt+_t,Ft+ct,vt,Xt,vt+_t,Xt+ct,O.COLOR_BUFFER_BIT,O.NEAREST):Cn?O.copyTexSubImage3D(bt,ut,vt,Xt,be+vi,Mt,Ft,_t,ct):O.copyTexSubImage2D(bt,ut,vt,Xt,Mt,Ft,_t,ct);dt.bindFramebuffer(O.READ_FRAMEBUFFER,null),dt.bindFramebuffer(O.DRAW_FRAMEBUFFER,null)}else Cn?v.isDataTexture||v.isData3DTexture?O.texSubImage3D(bt,ut,vt,Xt,be,_t,ct,xt,ie,He,se.data):L.isCompressedArrayTexture?O.compressedTexSubImage3D(bt,ut,vt,Xt,be,_t,ct,xt,ie,se.data):O.texSubImage3D(bt,ut,vt,Xt,be,_t,ct,xt,ie,He,se):v.isDataTexture?O.texSubImage2D(O.TEXTURE_2D,ut,vt,Xt,_t,ct,ie,He,se.data):v.isCompressedTexture?O.compressedTexSubImage2D(O.TEXTURE_2D,ut,vt,Xt,se.width,se.height,ie,se.data):O.texSubImage2D(O.TEXTURE_2D,ut,vt,Xt,_t,ct,ie,He,se);dt.pixelStorei(O.UNPACK_ROW_LENGTH,$e),dt.pixelStorei(O.UNPACK_IMAGE_HEIGHT,Zt),dt.pixelStorei(O.UNPACK_SKIP_PIXELS,Rn),dt.pixelStorei(O.UNPACK_SKIP_ROWS,Ge),dt.pixelStorei(O.UNPACK_SKIP_IMAGES,Jr),ut===0&&L.generateMipmaps===!0&&L.mipmapsAutoUpdate===!0&&O.generateMipmap(bt),dt.unbindTexture()},this.initRenderTarget=function(v){Ct.get(v).__webglFramebuffer===void 0&&Ut.setupRenderTarget(v)},this.initTexture=function(v){v.isCubeTexture?Ut.setTextureCube(v,0):v.isData3DTexture?Ut.setTexture3D(v,0):v.isDataArrayTexture||v.isCompressedArrayTexture?Ut.setTexture2DArray(v,0):Ut.setTexture2D(v,0),dt.unbindTexture()},this.resetState=function(){$=0,G=0,et=null,dt.reset(),ot.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return gi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(t){this._outputColorSpace=t;let e=this.getContext();e.drawingBufferColorSpace=qt._getDrawingBufferColorSpace(t),e.unpackColorSpace=qt._getUnpackColorSpace()}};var uf={type:"change"},gh={type:"start"},ff={type:"end"},ll=new Nn,df=new ai,cv=Math.cos(70*Qc.DEG2RAD),Re=new N,ii=2*Math.PI,Kt={NONE:-1,ROTATE:0,DOLLY:1,PAN:2,TOUCH_ROTATE:3,TOUCH_PAN:4,TOUCH_DOLLY_PAN:5,TOUCH_DOLLY_ROTATE:6},mh=1e-6,cl=class extends Rr{constructor(t,e=null){super(t,e),this.state=Kt.NONE,this.target=new N,this.cursor=new N,this.minDistance=0,this.maxDistance=1/0,this.minZoom=0,this.maxZoom=1/0,this.minTargetRadius=0,this.maxTargetRadius=1/0,this.minPolarAngle=0,this.maxPolarAngle=Math.PI,this.minAzimuthAngle=-1/0,this.maxAzimuthAngle=1/0,this.enableDamping=!1,this.dampingFactor=.05,this.enableZoom=!0,this.zoomSpeed=1,this.enableRotate=!0,this.rotateSpeed=1,this.keyRotateSpeed=1,this.enablePan=!0,this.panSpeed=1,this.screenSpacePanning=!0,this.keyPanSpeed=7,this.zoomToCursor=!1,this.autoRotate=!1,this.autoRotateSpeed=2,this.keys={LEFT:"ArrowLeft",UP:"ArrowUp",RIGHT:"ArrowRight",BOTTOM:"ArrowDown"},this.mouseButtons={LEFT:_n.ROTATE,MIDDLE:_n.DOLLY,RIGHT:_n.PAN},this.touches={ONE:yn.ROTATE,TWO:yn.DOLLY_PAN},this.target0=this.target.clone(),this.position0=this.object.position.clone(),this.zoom0=this.object.zoom,this._cursorStyle="auto",this._domElementKeyEvents=null,this._lastPosition=new N,this._lastQuaternion=new Je,this._lastTargetPosition=new N,this._quat=new Je().setFromUnitVectors(t.up,new N(0,1,0)),this._quatInverse=this._quat.clone().invert(),this._spherical=new Ts,this._sphericalDelta=new Ts,this._scale=1,this._panOffset=new N,this._rotateStart=new Lt,this._rotateEnd=new Lt,this._rotateDelta=new Lt,this._panStart=new Lt,this._panEnd=new Lt,this._panDelta=new Lt,this._dollyStart=new Lt,this._dollyEnd=new Lt,this._dollyDelta=new Lt,this._dollyDirection=new N,this._mouse=new Lt,this._performCursorZoom=!1,this._pointers=[],this._pointerPositions={},this._controlActive=!1,this._onPointerMove=uv.bind(this),this._onPointerDown=hv.bind(this),this._onPointerUp=dv.bind(this),this._onContextMenu=yv.bind(this),this._onMouseWheel=mv.bind(this),this._onKeyDown=gv.bind(this),this._onTouchStart=xv.bind(this),this._onTouchMove=_v.bind(this),this._onMouseDown=fv.bind(this),this._onMouseMove=pv.bind(this),this._interceptControlDown=vv.bind(this),this._interceptControlUp=bv.bind(this),this.domElement!==null&&this.connect(this.domElement),this.update()}set cursorStyle(t){this._cursorStyle=t,t==="grab"?this.domElement.style.cursor="grab":this.domElement.style.cursor="auto"}get cursorStyle(){return this._cursorStyle}connect(t){super.connect(t),this.domElement.addEventListener("pointerdown",this._onPointerDown),this.domElement.addEventListener("pointercancel",this._onPointerUp),this.domElement.addEventListener("contextmenu",this._onContextMenu),this.domElement.addEventListener("wheel",this._onMouseWheel,{passive:!1}),this.domElement.ownerDocument.addEventListener("keydown",this._interceptControlDown,{passive:!0,capture:!0}),this.domElement.style.touchAction="none"}disconnect(){this.state=Kt.NONE,this.domElement.removeEventListener("pointerdown",this._onPointerDown),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.domElement.removeEventListener("pointercancel",this._onPointerUp),this.domElement.removeEventListener("wheel",this._onMouseWheel),this.domElement.removeEventListener("contextmenu",this._onContextMenu),this.stopListenToKeyEvents(),this.domElement.ownerDocument.removeEventListener("keydown",this._interceptControlDown,{capture:!0}),this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{capture:!0}),this._controlActive=!1,this._pointers.length=0,this._pointerPositions={},this.domElement.style.touchAction="",this.domElement.style.cursor="auto"}dispose(){this.disconnect()}getPolarAngle(){return this._spherical.phi}getAzimuthalAngle(){return this._spherical.theta}getDistance(){return this.object.position.distanceTo(this.target)}listenToKeyEvents(t){t.addEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=t}stopListenToKeyEvents(){this._domElementKeyEvents!==null&&(this._domElementKeyEvents.removeEventListener("keydown",this._onKeyDown),this._domElementKeyEvents=null)}saveState(){this.target0.copy(this.target),this.position0.copy(this.object.position),this.zoom0=this.object.zoom}reset(){this.target.copy(this.target0),this.object.position.copy(this.position0),this.object.zoom=this.zoom0,this.object.updateProjectionMatrix(),this.dispatchEvent(uf),this.update(),this.state=Kt.NONE}pan(t,e){this._pan(t,e),this.update()}dollyIn(t){this._dollyIn(t),this.update()}dollyOut(t){this._dollyOut(t),this.update()}rotateLeft(t){this._rotateLeft(t),this.update()}rotateUp(t){this._rotateUp(t),this.update()}update(t=null){let e=this.object.position;Re.copy(e).sub(this.target),Re.applyQuaternion(this._quat),this._spherical.setFromVector3(Re),this.autoRotate&&this.state===Kt.NONE&&this._rotateLeft(this._getAutoRotationAngle(t)),this.enableDamping?(this._spherical.theta+=this._sphericalDelta.theta*this.dampingFactor,this._spherical.phi+=this._sphericalDelta.phi*this.dampingFactor):(this._spherical.theta+=this._sphericalDelta.theta,this._spherical.phi+=this._sphericalDelta.phi);let i=this.minAzimuthAngle,s=this.maxAzimuthAngle;isFinite(i)&&isFinite(s)&&(i<-Math.PI?i+=ii:i>Math.PI&&(i-=ii),s<-Math.PI?s+=ii:s>Math.PI&&(s-=ii),i<=s?this._spherical.theta=Math.max(i,Math.min(s,this._spherical.theta)):this._spherical.theta=this._spherical.theta>(i+s)/2?Math.max(i,this._spherical.theta):Math.min(s,this._spherical.theta)),this._spherical.phi=Math.max(this.minPolarAngle,Math.min(this.maxPolarAngle,this._spherical.phi)),this._spherical.makeSafe(),this.enableDamping===!0?this.target.addScaledVector(this._panOffset,this.dampingFactor):this.target.add(this._panOffset),this.target.sub(this.cursor),this.target.clampLength(this.minTargetRadius,this.maxTargetRadius),this.target.add(this.cursor);let r=!1;if(this.zoomToCursor&&this._performCursorZoom||this.object.isOrthographicCamera)this._spherical.radius=this._clampDistance(this._spherical.radius);else{let o=this._spherical.radius;this._spherical.radius=this._clampDistance(this._spherical.radius*this._scale),r=o!=this._spherical.radius}if(Re.setFromSpherical(this._spherical),Re.applyQuaternion(this._quatInverse),e.copy(this.target).add(Re),this.object.lookAt(this.target),this.enableDamping===!0?(this._sphericalDelta.theta*=1-this.dampingFactor,this._sphericalDelta.phi*=1-this.dampingFactor,this._panOffset.multiplyScalar(1-this.dampingFactor)):(this._sphericalDelta.set(0,0,0),this._panOffset.set(0,0,0)),this.zoomToCursor&&this._performCursorZoom){let o=null;if(this.object.isPerspectiveCamera){let a=Re.length();o=this._clampDistance(a*this._scale);let l=a-o;this.object.position.addScaledVector(this._dollyDirection,l),this.object.updateMatrixWorld(),r=!!l}else if(this.object.isOrthographicCamera){let a=new N(this._mouse.x,this._mouse.y,0);a.unproject(this.object);let l=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),this.object.updateProjectionMatrix(),r=l!==this.object.zoom;let c=new N(this._mouse.x,this._mouse.y,0);c.unproject(this.object),this.object.position.sub(c).add(a),this.object.updateMatrixWorld(),o=Re.length()}else console.warn("WARNING: OrbitControls.js encountered an unknown camera type - zoom to cursor disabled."),this.zoomToCursor=!1;o!==null&&(this.screenSpacePanning?this.target.set(0,0,-1).transformDirection(this.object.matrix).multiplyScalar(o).add(this.object.position):(ll.origin.copy(this.object.position),ll.direction.set(0,0,-1).transformDirection(this.object.matrix),Math.abs(this.object.up.dot(ll.direction))<cv?this.object.lookAt(this.target):(df.setFromNormalAndCoplanarPoint(this.object.up,this.target),ll.intersectPlane(df,this.target))))}else if(this.object.isOrthographicCamera){let o=this.object.zoom;this.object.zoom=Math.max(this.minZoom,Math.min(this.maxZoom,this.object.zoom/this._scale)),o!==this.object.zoom&&(this.object.updateProjectionMatrix(),r=!0)}return this._scale=1,this._performCursorZoom=!1,r||this._lastPosition.distanceToSquared(this.object.position)>mh||8*(1-this._lastQuaternion.dot(this.object.quaternion))>mh||this._lastTargetPosition.distanceToSquared(this.target)>mh?(this.dispatchEvent(uf),this._lastPosition.copy(this.object.position),this._lastQuaternion.copy(this.object.quaternion),this._lastTargetPosition.copy(this.target),!0):!1}_getAutoRotationAngle(t){return t!==null?ii/60*this.autoRotateSpeed*t:ii/60/60*this.autoRotateSpeed}_getZoomScale(t){let e=Math.abs(t*.01);return Math.pow(.95,this.zoomSpeed*e)}_rotateLeft(t){this._sphericalDelta.theta-=t}_rotateUp(t){this._sphericalDelta.phi-=t}_panLeft(t,e){Re.setFromMatrixColumn(e,0),Re.multiplyScalar(-t),this._panOffset.add(Re)}_panUp(t,e){this.screenSpacePanning===!0?Re.setFromMatrixColumn(e,1):(Re.setFromMatrixColumn(e,0),Re.crossVectors(this.object.up,Re)),Re.multiplyScalar(t),this._panOffset.add(Re)}_pan(t,e){let i=this.domElement;if(this.object.isPerspectiveCamera){let s=this.object.position;Re.copy(s).sub(this.target);let r=Re.length();r*=Math.tan(this.object.fov/2*Math.PI/180),this._panLeft(2*t*r/i.clientHeight,this.object.matrix),this._panUp(2*e*r/i.clientHeight,this.object.matrix)}else this.object.isOrthographicCamera?(this._panLeft(t*(this.object.right-this.object.left)/this.object.zoom/i.clientWidth,this.object.matrix),this._panUp(e*(this.object.top-this.object.bottom)/this.object.zoom/i.clientHeight,this.object.matrix)):(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - pan disabled."),this.enablePan=!1)}_dollyOut(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale/=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_dollyIn(t){this.object.isPerspectiveCamera||this.object.isOrthographicCamera?this._scale*=t:(console.warn("WARNING: OrbitControls.js encountered an unknown camera type - dolly/zoom disabled."),this.enableZoom=!1)}_updateZoomParameters(t,e){if(!this.zoomToCursor)return;this._performCursorZoom=!0;let i=this.domElement.getBoundingClientRect(),s=t-i.left,r=e-i.top,o=i.width,a=i.height;this._mouse.x=s/o*2-1,this._mouse.y=-(r/a)*2+1,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()}_clampDistance(t){return Math.max(this.minDistance,Math.min(this.maxDistance,t))}_handleMouseDownRotate(t){this._rotateStart.set(t.clientX,t.clientY)}_handleMouseDownDolly(t){this._updateZoomParameters(t.clientX,t.clientY),this._dollyStart.set(t.clientX,t.clientY)}_handleMouseDownPan(t){this._panStart.set(t.clientX,t.clientY)}_handleMouseMoveRotate(t){this._rotateEnd.set(t.clientX,t.clientY),this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(ii*this._rotateDelta.x/e.clientHeight),this._rotateUp(ii*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd),this.update()}_handleMouseMoveDolly(t){this._dollyEnd.set(t.clientX,t.clientY),this._dollyDelta.subVectors(this._dollyEnd,this._dollyStart),this._dollyDelta.y>0?this._dollyOut(this._getZoomScale(this._dollyDelta.y)):this._dollyDelta.y<0&&this._dollyIn(this._getZoomScale(this._dollyDelta.y)),this._dollyStart.copy(this._dollyEnd),this.zoomToCursor&&(this._performCursorZoom=!0,this._dollyDirection.set(this._mouse.x,this._mouse.y,1).unproject(this.object).sub(this.object.position).normalize()),this.update()}_handleMouseMovePan(t){this._panEnd.set(t.clientX,t.clientY),this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd),this.update()}_handleMouseWheel(t){this._updateZoomParameters(t.clientX,t.clientY),t.deltaY<0?this._dollyIn(this._getZoomScale(t.deltaY)):t.deltaY>0&&this._dollyOut(this._getZoomScale(t.deltaY)),this.update()}_handleKeyDown(t){let e=!1;switch(t.code){case this.keys.UP:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(ii*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,this.keyPanSpeed),e=!0;break;case this.keys.BOTTOM:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateUp(-ii*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(0,-this.keyPanSpeed),e=!0;break;case this.keys.LEFT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(ii*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(this.keyPanSpeed,0),e=!0;break;case this.keys.RIGHT:t.ctrlKey||t.metaKey||t.shiftKey?this.enableRotate&&this._rotateLeft(-ii*this.keyRotateSpeed/this.domElement.clientHeight):this.enablePan&&this._pan(-this.keyPanSpeed,0),e=!0;break}e&&(t.preventDefault(),this.update())}_handleTouchStartRotate(t){if(this._pointers.length===1)this._rotateStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._rotateStart.set(i,s)}}_handleTouchStartPan(t){if(this._pointers.length===1)this._panStart.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panStart.set(i,s)}}_handleTouchStartDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyStart.set(0,r)}_handleTouchStartDollyPan(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enablePan&&this._handleTouchStartPan(t)}_handleTouchStartDollyRotate(t){this.enableZoom&&this._handleTouchStartDolly(t),this.enableRotate&&this._handleTouchStartRotate(t)}_handleTouchMoveRotate(t){if(this._pointers.length==1)this._rotateEnd.set(t.pageX,t.pageY);else{let i=this._getSecondPointerPosition(t),s=.5*(t.pageX+i.x),r=.5*(t.pageY+i.y);this._rotateEnd.set(s,r)}this._rotateDelta.subVectors(this._rotateEnd,this._rotateStart).multiplyScalar(this.rotateSpeed);let e=this.domElement;this._rotateLeft(ii*this._rotateDelta.x/e.clientHeight),this._rotateUp(ii*this._rotateDelta.y/e.clientHeight),this._rotateStart.copy(this._rotateEnd)}_handleTouchMovePan(t){if(this._pointers.length===1)this._panEnd.set(t.pageX,t.pageY);else{let e=this._getSecondPointerPosition(t),i=.5*(t.pageX+e.x),s=.5*(t.pageY+e.y);this._panEnd.set(i,s)}this._panDelta.subVectors(this._panEnd,this._panStart).multiplyScalar(this.panSpeed),this._pan(this._panDelta.x,this._panDelta.y),this._panStart.copy(this._panEnd)}_handleTouchMoveDolly(t){let e=this._getSecondPointerPosition(t),i=t.pageX-e.x,s=t.pageY-e.y,r=Math.sqrt(i*i+s*s);this._dollyEnd.set(0,r),this._dollyDelta.set(0,Math.pow(this._dollyEnd.y/this._dollyStart.y,this.zoomSpeed)),this._dollyOut(this._dollyDelta.y),this._dollyStart.copy(this._dollyEnd);let o=(t.pageX+e.x)*.5,a=(t.pageY+e.y)*.5;this._updateZoomParameters(o,a)}_handleTouchMoveDollyPan(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enablePan&&this._handleTouchMovePan(t)}_handleTouchMoveDollyRotate(t){this.enableZoom&&this._handleTouchMoveDolly(t),this.enableRotate&&this._handleTouchMoveRotate(t)}_addPointer(t){this._pointers.push(t.pointerId)}_removePointer(t){delete this._pointerPositions[t.pointerId];for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId){this._pointers.splice(e,1);return}}_isTrackingPointer(t){for(let e=0;e<this._pointers.length;e++)if(this._pointers[e]==t.pointerId)return!0;return!1}_trackPointer(t){let e=this._pointerPositions[t.pointerId];e===void 0&&(e=new Lt,this._pointerPositions[t.pointerId]=e),e.set(t.pageX,t.pageY)}_getSecondPointerPosition(t){let e=t.pointerId===this._pointers[0]?this._pointers[1]:this._pointers[0];return this._pointerPositions[e]}_customWheelEvent(t){let e=t.deltaMode,i={clientX:t.clientX,clientY:t.clientY,deltaY:t.deltaY};switch(e){case 1:i.deltaY*=16;break;case 2:i.deltaY*=100;break}return t.ctrlKey&&!this._controlActive&&(i.deltaY*=10),i}};function hv(n){this.enabled!==!1&&(this._pointers.length===0&&(this.domElement.setPointerCapture(n.pointerId),this.domElement.ownerDocument.addEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.addEventListener("pointerup",this._onPointerUp)),!this._isTrackingPointer(n)&&(this._addPointer(n),n.pointerType==="touch"?this._onTouchStart(n):this._onMouseDown(n),this._cursorStyle==="grab"&&(this.domElement.style.cursor="grabbing")))}function uv(n){this.enabled!==!1&&(n.pointerType==="touch"?this._onTouchMove(n):this._onMouseMove(n))}function dv(n){switch(this._removePointer(n),this._pointers.length){case 0:this.domElement.releasePointerCapture(n.pointerId),this.domElement.ownerDocument.removeEventListener("pointermove",this._onPointerMove),this.domElement.ownerDocument.removeEventListener("pointerup",this._onPointerUp),this.dispatchEvent(ff),this.state=Kt.NONE,this._cursorStyle==="grab"&&(this.domElement.style.cursor="grab");break;case 1:let t=this._pointers[0],e=this._pointerPositions[t];this._onTouchStart({pointerId:t,pageX:e.x,pageY:e.y});break}}function fv(n){let t;switch(n.button){case 0:t=this.mouseButtons.LEFT;break;case 1:t=this.mouseButtons.MIDDLE;break;case 2:t=this.mouseButtons.RIGHT;break;default:t=-1}switch(t){case _n.DOLLY:if(this.enableZoom===!1)return;this._handleMouseDownDolly(n),this.state=Kt.DOLLY;break;case _n.ROTATE:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Kt.PAN}else{if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Kt.ROTATE}break;case _n.PAN:if(n.ctrlKey||n.metaKey||n.shiftKey){if(this.enableRotate===!1)return;this._handleMouseDownRotate(n),this.state=Kt.ROTATE}else{if(this.enablePan===!1)return;this._handleMouseDownPan(n),this.state=Kt.PAN}break;default:this.state=Kt.NONE}this.state!==Kt.NONE&&this.dispatchEvent(gh)}function pv(n){switch(this.state){case Kt.ROTATE:if(this.enableRotate===!1)return;this._handleMouseMoveRotate(n);break;case Kt.DOLLY:if(this.enableZoom===!1)return;this._handleMouseMoveDolly(n);break;case Kt.PAN:if(this.enablePan===!1)return;this._handleMouseMovePan(n);break}}function mv(n){this.enabled===!1||this.enableZoom===!1||this.state!==Kt.NONE||(n.preventDefault(),this.dispatchEvent(gh),this._handleMouseWheel(this._customWheelEvent(n)),this.dispatchEvent(ff))}function gv(n){this.enabled!==!1&&this._handleKeyDown(n)}function xv(n){switch(this._trackPointer(n),this._pointers.length){case 1:switch(this.touches.ONE){case yn.ROTATE:if(this.enableRotate===!1){this.state=Kt.NONE;break}this._handleTouchStartRotate(n),this.state=Kt.TOUCH_ROTATE;break;case yn.PAN:if(this.enablePan===!1){this.state=Kt.NONE;break}this._handleTouchStartPan(n),this.state=Kt.TOUCH_PAN;break;default:this.state=Kt.NONE}break;case 2:switch(this.touches.TWO){case yn.DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchStartDollyPan(n),this.state=Kt.TOUCH_DOLLY_PAN;break;case yn.DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchStartDollyRotate(n),this.state=Kt.TOUCH_DOLLY_ROTATE;break;default:this.state=Kt.NONE}break;default:this.state=Kt.NONE}this.state!==Kt.NONE&&this.dispatchEvent(gh)}function _v(n){switch(this._trackPointer(n),this.state){case Kt.TOUCH_ROTATE:if(this.enableRotate===!1)return;this._handleTouchMoveRotate(n),this.update();break;case Kt.TOUCH_PAN:if(this.enablePan===!1)return;this._handleTouchMovePan(n),this.update();break;case Kt.TOUCH_DOLLY_PAN:if(this.enableZoom===!1&&this.enablePan===!1)return;this._handleTouchMoveDollyPan(n),this.update();break;case Kt.TOUCH_DOLLY_ROTATE:if(this.enableZoom===!1&&this.enableRotate===!1)return;this._handleTouchMoveDollyRotate(n),this.update();break;default:this.state=Kt.NONE}}function yv(n){this.enabled!==!1&&n.preventDefault()}function vv(n){n.key==="Control"&&(this._controlActive=!0,this.domElement.ownerDocument.addEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}function bv(n){n.key==="Control"&&(this._controlActive=!1,this.domElement.ownerDocument.removeEventListener("keyup",this._interceptControlUp,{passive:!0,capture:!0}))}var hl=class{constructor(t,e,i){this.strips=t;let s=new pn(1,1,1,8).translate(0,.5,0),r=new br(2.6,1,12).translate(0,.5,0),o=new Zi({color:e,emissive:e,emissiveIntensity:.35,transparent:i<1,opacity:i});this.group=new ge,this.shafts=new Ms(s,o,2*t),this.heads=new Ms(r,o,2*t),this.group.add(this.shafts,this.heads);for(let a of this.group.children)a.frustumCulled=!1}show(t,e,{scale:i,thickness:s}){let[r,o,a,l,c,h]=[new N(0,1,0),new N,new N,new N,new Je,new $t];for(let u=0;u<2*this.strips;u++){let d=u<this.strips?1:-1,f=u%this.strips,[p,_,g]=[0,1,2].map(w=>{let E=12*f+w;return .375*(e[E]+e[E+3])+.125*(e[E+6]+e[E+9])});a.set(p,d*_,g),o.set(t[3*f],d*t[3*f+1],t[3*f+2]).multiplyScalar(i);let m=o.length(),b=Math.min(8*s,.5*m),S=Math.min(s,.12*m);c.setFromUnitVectors(r,m>0?o.divideScalar(m):o.copy(r)),this.shafts.setMatrixAt(u,h.compose(a,c,l.set(S,m-b,S))),a.addScaledVector(o,m-b),this.heads.setMatrixAt(u,h.compose(a,c,l.set(S,b,S)))}this.shafts.instanceMatrix.needsUpdate=this.heads.instanceMatrix.needsUpdate=!0}};function Xn(n,t){let e=Object.keys(n[0]),i=n.map((s,r)=>{let[o,a,l]=[n[r-1],n[r],n[r+1]];return Object.fromEntries(e.map(c=>{if(!o||!l)return[c,0];let[h,u]=[a[c]-o[c],l[c]-a[c]];return[c,h*u<=0?0:2*h*u/(h+u)]}))});return Array.from({length:t},(s,r)=>{let o=r/(t-1)*(n.length-1),a=Math.min(Math.floor(o),n.length-2),l=o-a,[c,h,u,d]=[(1+2*l)*(1-l)**2,l*(1-l)**2,l*l*(3-2*l),l*l*(l-1)];return Object.fromEntries(e.map(f=>[f,c*n[a][f]+h*i[a][f]+u*n[a+1][f]+d*i[a+1][f]]))})}function qn(n,t,e=20){let[i,s,r]=[[],[],[]];return n.forEach((o,a)=>{let[l,c]=[n[Math.max(a-1,0)],n[Math.min(a+1,n.length-1)]],[h,u]=[c.x-l.x,c.z-l.z],d=Math.hypot(h,u)||1;for(let f=0;f<e;f++){let[p,_]=[Math.cos(2*Math.PI*f/e),Math.sin(2*Math.PI*f/e)],g=_*(_>0?o.up:o.down);i.push(o.x+u/d*g,p*o.wide,o.z-h/d*g);let m=t(o,_);s.push(m.r,m.g,m.b)}}),pf(n.length,e,r),xh(i,s,r)}function Ns(n,t,e,i=7){let[s,r,o]=[[],[],[]],[a,l,c]=[new N,new N,new N];return n.forEach((h,u)=>{let[d,f]=[n[Math.max(u-1,0)],n[Math.min(u+1,n.length-1)]];a.set(f[0]-d[0],f[1]-d[1],f[2]-d[2]).normalize(),l.set(0,0,1).cross(a),l.lengthSq()<1e-6&&l.set(0,1,0),l.normalize(),c.copy(a).cross(l);for(let p=0;p<i;p++){let[_,g]=[Math.cos(2*Math.PI*p/i),Math.sin(2*Math.PI*p/i)];["x","y","z"].forEach((m,b)=>s.push(h[b]+t[u]*(_*l[m]+g*c[m]))),r.push(e.r,e.g,e.b)}}),pf(n.length,i,o),xh(s,r,o)}function $n(n,t){let[e,i,s]=[[],[],[]],r=n[0].length;n.forEach((o,a)=>o.forEach((l,c)=>{e.push(...l);let h=t(a/(n.length-1),c/(r-1));i.push(h.r,h.g,h.b)}));for(let o=1;o<n.length;o++)for(let a=1;a<r;a++){let[l,c,h,u]=[(o-1)*r+a-1,(o-1)*r+a,o*r+a,o*r+a-1];s.push(l,c,h,l,h,u)}return xh(e,i,s)}function pf(n,t,e){for(let i=1;i<n;i++)for(let s=0;s<t;s++){let[r,o]=[s,(s+1)%t],[a,l,c,h]=[(i-1)*t+r,(i-1)*t+o,i*t+o,i*t+r];e.push(a,l,c,a,c,h)}}function xh(n,t,e){let i=new ue;return i.setAttribute("position",new Jt(n,3)),i.setAttribute("color",new Jt(t,3)),i.setIndex(e),i.computeVertexNormals(),i}function Yn(n,t){let e=n.getAttribute("position").count,i=new Float32Array(3*e);for(let s=0;s<e;s++)t.toArray(i,3*s);return n.setAttribute("color",new Ne(i,3)),n}function _e(n){return new Pt(n)}function ze(n,t,e){return n.clone().lerp(t,Math.min(Math.max(e,0),1))}function ye(n,t){return n.clone().multiplyScalar(t)}function _i(n,t,e){let i=Math.min(Math.max((n-t)/(e-t),0),1);return i*i*(3-2*i)}function ae(n,t,e){return Array.from({length:e},(i,s)=>n+(t-n)*s/(e-1))}function Hr(n){return new Zi({vertexColors:!0,side:Me,transparent:n<1,opacity:n,depthWrite:n>.5})}function mf(n){let{length:t,width:e,depth:i,head_length:s,ear_length:r}=n.body,o=Object.fromEntries(Object.entries(n.colours).map(([p,_])=>[p,_e(_)])),a=.5*t,l=.36*s,c=.12*i,h=(p,_,g,m,b=m)=>({x:p,z:_,wide:g,up:m,down:b}),u=Xn([h(a,c-.25*l,.01*l,.01*l),h(a-.05*s,c-.22*l,.4*l,.34*l),h(a-.24*s,c-.15*l,.5*l,.48*l),h(a-.46*s,c,.88*l,.86*l),h(a-.74*s,c,1.05*l,1.04*l),h(a-1.02*s,.6*c,Math.max(.95*l,.3*e),.9*l,l),h(.1*t,0,.5*e,.46*i,.54*i),h(-.08*t,0,.5*e,.46*i,.52*i),h(-.28*t,0,.38*e,.36*i,.38*i),h(-.42*t,0,.22*e,.2*i,.2*i),h(-.5*t,0,.01*e,.01*i,.01*i)],28),f=[qn(u,({x:p},_)=>{let g=ze(o.breast,o.back,_i(_,-.3,.45)),m=ze(o.head,o.wing,_i(p,a-.28*s,a-.05*s));return ze(g,m,_i(p,a-1.2*s,a-.9*s))},16)];for(let p of[1,-1]){f.push(wv({front:a,head:s,skull:l,lift:c,ear:r},p,o));for(let[_,g,m]of[[.15,0,_e("#120e0c")],[.05,.12*l,_e("#ffffff")]]){let b=new Bn(_*l,8,6);f.push(Yn(b.translate(a-.32*s+g*.5,p*(.6*l+g),c+.28*l+.5*g),m))}}return[...f,...Mv(n.body,o)]}function wv({front:n,head:t,skull:e,lift:i,ear:s},r,o){let a=[n-.72*t,r*.55*e,i+.6*e],l=ae(0,1,8).map(c=>{let h=.34*s*Math.sqrt(Math.max(1-c**2.2,0))*(.7+.5*c);return ae(-1,1,7).map(u=>[a[0]-.3*s*c*c-.5*h*(1-u*u)+.1*s*c,a[1]+r*(.35*s*c)+h*u,a[2]+s*(1.1*c-.12)])});return $n(l,(c,h)=>ze(o.wing,o.head,.4+.4*Math.abs(2*h-1)).multiplyScalar(1.05-.2*c))}function _h({length:n,width:t,tail_length:e}){return[-.5*n-.55*Math.max(e,.12*n),.45*t,-.02*n]}function Mv(n,t){let{length:e,width:i,tail_length:s}=n,r=_h(n),o=[-.4*e,.14*i,0],a=[1,-1].map(h=>{let u=[o,r].map(([d,f,p])=>[d,h*f,p]);return Ns(u,[.06*i,.035*i],ye(t.wing_tip,1.1))}),l=[-.5*e-s,0,-.02*e];s>0&&a.push(Ns([[-.42*e,0,0],l],[.05*i,.02*i],ye(t.wing_tip,1.1)));let c=ae(0,1,4).map(h=>ae(-1,1,13).map(u=>{let d=Math.abs(u),f=l[0]+(r[0]-l[0])*d+.3*d*(1-d)*2*Math.max(s,.1*e);return[o[0]+(f-o[0])*h,u*(o[1]+(r[1]-o[1])*h),-.02*e*h]}));return[...a,$n(c,()=>t.wing)]}var Sv=[0,.25,.55,.78,.9,.97,1],Ev=[-1,0,1],Tv=.07,yh=.375;function gf(n,t,e){return 2*yh*xf(n,t,e)}function xf(n,t,e){let i=n<1-e?1:Math.sqrt(Math.max(1-((n-1+e)/e)**2,0));return t(n)*(.45+.55*Math.min(n/.3,1))*i}function ul({path:n,half:t,round:e=.22,along:i=Sv,tint:s,tilt:r=Tv},o){return i.map(a=>{let[l,c,h]=[n(a),n(Math.max(a-.02,0)),n(Math.min(a+.02,1))],[u,d]=[h[0]-c[0],h[1]-c[1]],f=Math.hypot(u,d)||1,p=xf(a,t,e);return Ev.map(_=>{let g=2*p*_*(_>0?yh:1-yh),m=_===0?.9:_>0?.84:1.06;return o(a,l,[d/f*g,-u/f*g],r*_*p,ye(s(a),m))})})}var _f=10;function yf(n,t){let{length:e,width:i,depth:s,head_length:r,bill_length:o}=n.body,a=Object.fromEntries(Object.entries(n.colours).map(([T,x])=>[T,_e(x)])),l=.47*e,c=l-e,h=.36*r,u=.2*s,d=(T,x,M,D,P=D)=>({x:T,z:x,wide:M,up:D,down:P}),[f,p]=[l-.9*r,Math.min(.06*e,l-1.5*r)],_=T=>{let x=(D,P,U)=>D+(P-D)*U,M=(T*T*(3-2*T))**1.2;return d(x(f,p,T),x(.52*u,0,T),x(.95*h,.5*i,M),x(.98*h,.4*s,M),x(1*h,.58*s,.5*(M+T)))},g=[d(l+.14*Math.min(o,.5*r),.36*u,.06*h,.06*h,.12*h),d(l-.03*r,.4*u,.44*h,.5*h,.46*h),d(l-.2*r,.5*u,.74*h,.86*h,.76*h),d(l-.48*r,.56*u,.94*h,1.04*h,.95*h),...[0,.25,.5,.75,1].map(_),d(-.1*e,0,.48*i,.4*s,.56*s),d(-.26*e,.02*s,.38*i,.33*s,.4*s),d(-.4*e,.05*s,.24*i,.2*s,.24*s),d(c,.07*s,.12*i,.07*s,.08*s)],m=Xn(g,32),b=Av(m,p-.12*e,l-.7*r,t),w=[qn(m,(T,x)=>{let M=ze(a.breast,a.back,_i(x,-.25,.5));return ze(M,ye(a.head,1-.06*x),_i(T.was,l-1.25*r,l-.85*r))},16)],E={x:l-.1*r,z:.42*u};return w.push(...Rv(E,{head:r,skull:h,bill:o,neck:u,front:l},a).map(T=>T.applyMatrix4(b))),w.push(...Cv(n.body,t,{x:c+.06*e,z:.06*s},a)),w}function Av(n,t,e,i){let s=.85*i.mean("body_pitch"),r=n.filter(({x:a})=>a>t).at(-1),o={x:r.x,z:r.z};for(let a of n){a.was=a.x;let[l,c]=[a.x-o.x,a.z-o.z],h=-s*_i(a.x,t,e);a.x=o.x+Math.cos(h)*l-Math.sin(h)*c,a.z=o.z+Math.sin(h)*l+Math.cos(h)*c}return new $t().makeTranslation(o.x,0,o.z).multiply(new $t().makeRotationY(s)).multiply(new $t().makeTranslation(-o.x,0,-o.z))}function Rv(n,{head:t,skull:e,bill:i,neck:s,front:r},o){let a=[];if(i>0){let h=e*Math.min(Math.max(.3*t/i,.13),.46),u=i+.1*t,d=[0,.12,.35,.65,.9,1].map((f,p)=>({x:n.x+u*f,z:n.z-.12*e-.25*h*f**2,wide:.8*h*[1,.95,.7,.45,.24,.02][p],up:h*[1,.95,.75,.5,.26,.02][p],down:h*[.9,.8,.6,.42,.3,.02][p]})).reverse();a.push(qn(Xn(d,8),(f,p)=>ye(o.bill,1+.1*p),8))}let[l,c]=[_e("#15110e"),ze(o.head,_e("#ffffff"),.28)];for(let h of[1,-1]){let u=[r-.4*t,h*.84*e,.62*s+.22*e],d=(f,p,_,g=0,m=0)=>Yn(new Bn(f*e,9,6).translate(u[0]+g,u[1]+h*p,u[2]+m),_);a.push(d(.25,-.08*e,c),d(.2,.005*e,l)),a.push(d(.055,.15*e,_e("#ffffff"),.05*e,.1*e))}return a}function Cv({tail_length:n,tail_width:t},e,i,s){if(!(n>0))return[];let r=vh(e),o=Math.atan2(.5*t,n),a=.12*n;return ae(-1,1,_f).map(l=>{let c=l*o,h=n/Math.cos(o*.6)*(1-.06*l*l)+a,u=Math.max(.75*t/_f,.05*n),d=b=>[-Math.cos(c)*h*b,Math.sin(c)*h*b],f=b=>ze(s.back,s.wing_tip,.25+.6*_i(b,.6,1)),p=.035*t*(1-l*l),g=ul({path:d,half:()=>u,round:.16,tint:f,tilt:.1},(b,S,w,E,T)=>({at:[S[0]+w[0],S[1]+w[1],Math.abs(l)<.2?p:p-Math.sign(l)*E],tone:T})),m=([b,S,w])=>[i.x+Math.cos(r)*(b+a)-Math.sin(r)*w,S,i.z+Math.sin(r)*(b+a)+Math.cos(r)*w];return $n(g.map(b=>b.map(({at:S})=>m(S))),(b,S)=>g[Math.round(b*(g.length-1))][Math.round(S*(g[0].length-1))].tone)})}function vh({tail:n}){if(!n)return 0;let[t,e]=[n[0]-.5*(n[3]+n[6]),n[2]-.5*(n[5]+n[8])];return Math.atan2(e,t)}function vf(n,t){let{length:e,width:i,depth:s,tail_length:r,tail_width:o}=n.body,a=Object.fromEntries(Object.entries(n.colours).map(([_,g])=>[_,_e(g)])),[l,c]=[.5*e,-.5*e],h=.06*Math.min(i,s),u=ye(a.back,.7),d=[Ns([[l,0,0],[c-.1*r,0,0]],[h,h],u,8)],f=[{x:l,z:0,wide:.02*i,up:.02*s,down:.02*s},{x:l-.06*e,z:0,wide:.24*i,up:.22*s,down:.26*s},{x:l-.22*e,z:0,wide:.38*i,up:.32*s,down:.42*s},{x:l-.36*e,z:0,wide:.34*i,up:.26*s,down:.4*s},{x:l-.4*e,z:0,wide:.02*i,up:.02*s,down:.02*s}];d.push(qn(Xn(f,24),(_,g)=>ze(a.breast,a.head,.5+.5*g),18));let p=(_,g,m)=>Yn(new fn(..._).translate(...g),m);d.push(p([.18*e,.5*i,.34*s],[0,0,-.02*s],a.back)),d.push(p([.22*e,.3*i,.2*s],[-.22*e,0,-.12*s],a.bill));for(let[_,g]of[[.06,.24],[-.05,.16]])for(let m of[1,-1]){let b=new pn(g*s,g*s,.04*i,20);d.push(Yn(b.translate(_*e,m*.29*i,.08*s),ye(a.bill,1.25)))}return r>0?[...d,...Pv(t,{reach:r,wide:o,rear:c},a,h)]:d}function Pv(n,{reach:t,wide:e,rear:i},s,r){let o=vh(n),a=[i+.05*t,0,.5*r],l=p=>[a[0]-Math.cos(o)*t,.5*p*e,a[2]-Math.sin(o)*t],[c,h]=[l(1),l(-1)],u=c.map((p,_)=>.5*(p+h[_])+(_===0?.08*t:0)),d=ye(s.back,.8),f=p=>Ns([a,p],[.5*r,.4*r],d,6);return[$n([[a,a,a],[c,u,h]],()=>s.wing),f(c),f(h),f(u)]}var Us=[-.22,-.34],bf=1.7,wf=160,Gr=1,dl=class{constructor(t){this.scene=t,this.target=new Ke(wf,wf,{samples:4,depthBuffer:!1}),this.black=new Un({color:0,side:Me}),this.camera=new kn,this.camera.matrixAutoUpdate=!1,this.camera.layers.set(Gr);let e=new Un({map:this.target.texture,transparent:!0,depthWrite:!1});this.ground=new de(new Fn(2,2),e),t.add(this.ground)}place(t,e,i,s){let r=t.z-e,o=[t.x+Us[0]*r,t.y+Us[1]*r],a=[bf*i,bf*i+.5*s];this.ground.position.set(...o,e+.002*i),this.ground.scale.set(...a,1),this.camera.projectionMatrix.set(1/a[0],0,Us[0]/a[0],-(o[0]+Us[0]*e)/a[0],0,1/a[1],Us[1]/a[1],-(o[1]+Us[1]*e)/a[1],0,0,0,0,0,0,0,1),this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert(),this.stale=!0}tint(t){this.ground.material.opacity=t==="dark"?.6:.26}draw(t){this.stale&&(this.stale=!1,this.scene.overrideMaterial=this.black,t.setRenderTarget(this.target),t.setClearColor(0,0),t.clear(),t.render(this.scene,this.camera),t.setRenderTarget(null),this.scene.overrideMaterial=null)}dispose(){this.ground.geometry.dispose(),this.ground.material.dispose(),this.black.dispose(),this.target.dispose()}};var Iv={bird:yf,bat:mf,robot:vf},fl=class{constructor(t,e){this.group=new ge;let i=Hr(e);for(let s of Iv[t.shape.kind](t.shape,t)){let r=new de(s,i);e===1&&r.layers.enable(Gr),this.group.add(r)}}show(t){this.group.rotation.y=-t}};var pl=class{constructor(t,e,i){this.side=e;let s=new ue;s.setAttribute("position",new Ne(new Float32Array(t*12),3)),s.setAttribute("color",new Ne(new Float32Array(t*12),3));let r=[],o=[];for(let h=0;h<t;h++){let[u,d,f,p]=[0,1,2,3].map(_=>4*h+_);r.push(...e>0?[u,d,f,u,f,p]:[u,f,d,u,p,f]),o.push(u,d,d,f,f,p,p,u)}s.setIndex(r);let a=new ue;a.setAttribute("position",s.getAttribute("position")),a.setIndex(o);let l=i===1,c=new Zi({vertexColors:!0,side:Me,transparent:!l,opacity:i,depthWrite:l});this.edges=new On(a,new Ss({transparent:!0,opacity:.45*i})),this.mesh=new de(s,c),this.mesh.add(this.edges),this.mesh.frustumCulled=this.edges.frustumCulled=!1}show(t,e,i){let{geometry:s}=this.mesh,r=s.getAttribute("position"),o=s.getAttribute("color");for(let l=0;l<t.length;l+=3)r.array[l]=t[l],r.array[l+1]=this.side*t[l+1],r.array[l+2]=t[l+2];let a=new Pt;for(let l=0;l<e.length;l++){a.setRGB(...jr(e[l],i),xe);for(let c=0;c<4;c++)a.toArray(o.array,12*l+3*c)}r.needsUpdate=o.needsUpdate=!0,s.computeVertexNormals()}};var Lv=`
attribute vec3 along;
attribute vec3 shade;
attribute float shed, strength, side, slim;
uniform float now, life, width, spread, opacity, toned, floorHeight, floorDepth;
uniform vec3 drift, tone;
varying vec4 colour;
varying float age, across;
void main() {
  age = now - shed;
  across = side;
  float share = clamp(age / life, 0.0, 1.0);
  vec3 moved = position + max(age, 0.0) * drift;
  float over = ((modelMatrix * vec4(moved, 1.0)).z - floorHeight) / floorDepth;
  float seen = opacity * strength * pow(1.0 - share, 1.5) * clamp(over, 0.0, 1.0);
  colour = vec4(mix(shade, tone, toned), seen);
  vec4 eye = modelViewMatrix * vec4(moved, 1.0);
  vec3 way = cross((modelViewMatrix * vec4(along, 0.0)).xyz, normalize(eye.xyz));
  // A path along the line of sight has no side to widen to: there the ribbon narrows.
  way /= max(max(length(way), 0.25 * length(along)), 1e-9);
  eye.xyz += way * side * slim * 0.5 * width * mix(1.0, spread, share);
  gl_Position = projectionMatrix * eye;
}`,Dv=`
uniform float soft;
varying vec4 colour;
varying float age, across;
void main() {
  if (age < 0.0) discard;
  gl_FragColor = vec4(colour.rgb, colour.a * smoothstep(0.0, soft, 1.0 - abs(across)));
}`,[Nv,Uv]=[.5,.05];function Ov(n,t){return t.map((e,i)=>{let[s,r]=[Math.max(i-1,0),Math.min(i+1,t.length-1)],o=t[r]-t[s];return o===0?0:Math.hypot(...[0,1,2].map(a=>(n[3*r+a]-n[3*s+a])/o))})}var wn=class{constructor({points:t,shed:e,shades:i,strengths:s,width:r,spread:o,life:a,drift:l=[0,0,0],soft:c,opacity:h}){[this.shed,this.life]=[e,a];let u=e.length,d={position:[],along:[],shade:[],shed:[],strength:[],side:[],slim:[]},f=Ov(t,e),p=Nv*Math.max(...f);for(let S=0;S<u;S++){let w=Math.max(S-1,0),E=Math.min(S+1,u-1),T=e[E]-e[w],x=[0,1,2].map(M=>t[3*E+M]-t[3*w+M]-T*l[M]);for(let M of[-1,1])d.position.push(t[3*S],t[3*S+1],t[3*S+2]),d.along.push(...x),d.shade.push(...i?i.slice(3*S,3*S+3):[0,0,0]),d.shed.push(e[S]),d.strength.push(s?s[S]:1),d.side.push(M),d.slim.push(p>0?Math.min(Math.max(f[S]/p,Uv),1):1)}let _=new ue;for(let[S,w]of Object.entries(d))_.setAttribute(S,new Jt(w,w.length/(2*u)));let g=[];for(let S=0;S<u-1;S++)g.push(2*S,2*S+1,2*S+2,2*S+2,2*S+1,2*S+3);_.setIndex(g);let m={now:0,life:a,width:r,spread:o,opacity:h,soft:c,toned:i?0:1,floorHeight:-1e6,floorDepth:1},b=new Xe({vertexShader:Lv,fragmentShader:Dv,uniforms:{...Object.fromEntries(Object.entries(m).map(([S,w])=>[S,{value:w}])),drift:{value:new N(...l)},tone:{value:new N}},transparent:!0,depthWrite:!1,side:Me});this.mesh=new de(_,b),this.mesh.frustumCulled=!1}show(t,e=[-1e6,1]){let{uniforms:i}=this.mesh.material;i.now.value=t;let s=Math.max(this.shed.findIndex(a=>a>t-this.life)-1,0),r=this.shed.findIndex(a=>a>t),o=r<0?this.shed.length-1:r;this.mesh.geometry.setDrawRange(6*s,6*Math.max(o-s,0)),[i.floorHeight.value,i.floorDepth.value]=e}tint(t){let{r:e,g:i,b:s}=new Pt(t).getRGB({},xe);this.mesh.material.uniforms.tone.value.set(e,i,s)}};var Fv=1,ml=class{constructor(t,e){let i=eo(t,1),s=i.map(({k:c,shift:h})=>t.phase[c]+h.phase);this.force=jn(t),this.along=i;let r={shed:s,life:Fv,soft:.35},o=[1,-1].map(c=>{let h=i.flatMap(d=>io(t,d,c)),u=new Array(h.length).fill(0);return new wn({...r,points:h,shades:u,width:.07*t.semi_span,spread:.3,opacity:.95*e})}),a=i.flatMap(c=>Gs(t,c)),l=new wn({...r,points:a,width:.016*t.semi_span,spread:1,opacity:.5*e});[this.left,this.right,this.body]=[...o,l],this.group=new ge;for(let c of this.ribbons)this.group.add(c.mesh)}get ribbons(){return[this.left,this.right,this.body]}scale(t){this.most=t;for(let e of[this.left,this.right]){let i=e.mesh.geometry.getAttribute("shade");this.along.forEach(({k:s},r)=>{let o=Qh(t>0?this.force[s]/t:0);for(let a of[2*r,2*r+1])i.setXYZ(a,...o)}),i.needsUpdate=!0}}show(t,e){e!==this.most&&this.scale(e);for(let i of this.ribbons)i.show(t)}tint(t){this.body.tint(t)}};var Mf=3,gl=33,Bv={light:"#1f6fb2",dark:"#a8d4ff"},xl=class{constructor(t,e){if(this.group=new ge,this.ribbons=[],!t.wake)return;let[i,s]=t.wake.induced.map(u=>u/t.frequency),r=eo(t,Mf),o=r.map(({k:u,shift:d})=>t.phase[u]+d.phase),a=jn(t),l=Math.max(...a,1e-12),c={life:Mf,drift:[i,0,s],spread:2.2,soft:1,opacity:.85*e},h=r.map(({k:u})=>a[u]/l);for(let u of[1,-1]){let d=r.flatMap(f=>io(t,f,u));this.ribbons.push(new wn({...c,points:d,shed:o,strengths:h,width:.16*t.semi_span}))}for(let u of r.filter((d,f)=>zv(t,r,f))){let d=kv(t,u),f=new Array(gl).fill(t.phase[u.k]+u.shift.phase),p=f.map((g,m)=>{let b=Math.min(m,gl-1-m);return Math.min(b/3,1)*(.75-1.2*b/(gl-1))}),_=.12*t.semi_span;this.ribbons.push(new wn({...c,points:d,shed:f,strengths:p,width:_}))}for(let u of this.ribbons)this.group.add(u.mesh)}show(t,e){for(let i of this.ribbons)i.show(t,e)}tint(t){for(let e of this.ribbons)e.tint(Bv[t])}};function kv(n,t){let e=r=>[1,.75,.5].map(o=>Xl(n,t,o,r)),i=[...e(1),Gs(n,t),...e(-1).reverse()];return new wr(i.map(r=>new N(...r))).getPoints(gl-1).flatMap(r=>r.toArray())}function zv(n,t,e){if(e===0)return!1;let[i,s]=[t[e-1],t[e]].map(({k:a,shift:l})=>n.phase[a]+l.phase),r=[t[e].shift.phase,t[e].shift.phase+n.last];return n.downstrokes.flat().flatMap(a=>(n.periodic?r:[0]).map(l=>l+a)).some(a=>i<a&&a<=s)}var Zn=class{constructor(t){this.strips=t,this.knots=new Float64Array((2*t+1)*12)}set(t){let{strips:e,knots:i}=this;i.fill(0);for(let s=0;s<e;s++){let r=[s?.5:1,1,s<e-1?.5:1],[o,a]=[new Array(3),new Array(3)];for(let c=0;c<3;c++){let[h,u,d,f]=[0,3,6,9].map(g=>t[12*s+g+c]),[p,_]=[.75*h+.25*f,.75*u+.25*d];[p,.5*(p+_),_].forEach((g,m)=>{i[(2*s+m)*12+c]+=r[m]*g}),o[c]=h+u-d-f,a[c]=_-p}_l(o),_l(a);let l=Hv(o,a);for(let c=0;c<3;c++){let h=(2*s+c)*12;for(let u=0;u<3;u++)i[h+3+u]+=o[u],i[h+6+u]+=l[u],i[h+9+u]+=a[u]}}for(let s=0;s<=2*e;s++)for(let r of[3,6,9])_l(i,s*12+r)}read(t,e,i=0){let s=Math.min(Math.max(t,0),1)*2*this.strips,r=Math.min(Math.floor(s+1e-9),2*this.strips-1),o=s-r;for(let a=0;a<12;a++){let l=this.knots[r*12+a];e[i+a]=l+o*(this.knots[(r+1)*12+a]-l)}for(let a of[3,6,9])_l(e,i+a)}place(t,e,i){let s=new Float64Array(12);return this.read(t,s),[0,1,2].map(r=>s[r]+e*s[3+r]+i*s[6+r])}};Zn.AXES=12;function _l(n,t=0){let e=Math.hypot(n[t],n[t+1],n[t+2])||1;for(let i=t;i<t+3;i++)n[i]/=e}function Hv(n,t){return[n[1]*t[2]-n[2]*t[1],n[2]*t[0]-n[0]*t[2],n[0]*t[1]-n[1]*t[0]]}var{AXES:bh}=Zn,yi=class{constructor(){this.stations=[],this.known=new Map,this.points=[],this.colours=[],this.index=[],this.seams=[]}add(t,e,i,s,r){let o=Math.round(1e5*t);return this.known.has(o)||(this.known.set(o,this.stations.length),this.stations.push(t)),this.points.push(this.known.get(o),e,i,s),this.colours.push(r.r,r.g,r.b),this.points.length/4-1}hold(t,e){this.seams.push({point:t,place:e})}grid(t){for(let e=1;e<t.length;e++)for(let i=1;i<t[e].length;i++){let[s,r,o,a]=[t[e-1][i-1],t[e][i-1],t[e][i],t[e-1][i]];this.index.push(s,a,o,s,o,r)}}},Vr=class{constructor(t,e){this.sheet=t;let i=t.points.length/4;this.points=Float64Array.from(t.points),this.frames=new Float64Array(t.stations.length*bh),this.meshes=[1,-1].map(s=>{let r=new ue;for(let l of["position","normal"])r.setAttribute(l,new Ne(new Float32Array(3*i),3));r.setAttribute("color",new Jt(t.colours,3));let o=s>0?t.index:t.index.map((l,c,h)=>h[c-c%3+(3-c%3)%3]);r.setIndex(o);let a=new de(r,e);return a.frustumCulled=!1,a})}show(t,e){let{sheet:i,points:s,frames:r}=this,[o,a]=this.meshes.map(({geometry:u})=>u.attributes),l=o.position.array;i.stations.forEach((u,d)=>t.read(u,r,d*bh));for(let u=0,d=0;u<s.length;u+=4,d+=3){let f=s[u]*bh;for(let p=0;p<3;p++)l[d+p]=r[f+p]+s[u+1]*r[f+3+p]+s[u+2]*r[f+6+p]+s[u+3]*r[f+9+p]}let[c,h]=[Math.cos(e),Math.sin(e)];for(let{point:u,place:[d,f,p]}of i.seams)l.set([c*d-h*p,f,h*d+c*p],3*u);Gv(l,i.index,o.normal.array);for(let u of["position","normal"]){a[u].array.set(o[u].array);for(let d=1;d<a[u].array.length;d+=3)a[u].array[d]*=-1;o[u].needsUpdate=a[u].needsUpdate=!0}}};function Gv(n,t,e){e.fill(0);for(let i=0;i<t.length;i+=3){let[s,r,o]=[3*t[i],3*t[i+1],3*t[i+2]],[a,l,c]=[n[r]-n[s],n[r+1]-n[s+1],n[r+2]-n[s+2]],[h,u,d]=[n[o]-n[s],n[o+1]-n[s+1],n[o+2]-n[s+2]],[f,p,_]=[l*d-c*u,c*h-a*d,a*u-l*h];for(let g of[s,r,o])e[g]+=f,e[g+1]+=p,e[g+2]+=_}for(let i=0;i<e.length;i+=3){let s=Math.hypot(e[i],e[i+1],e[i+2])||1;e[i]/=s,e[i+1]/=s,e[i+2]/=s}}var Sf=10,yl=6,Vv=26,Wv=[0,.6,.88,1];function Tf(n){let t=new yi,{semiSpan:e}=n,i={wing:_e(n.colours.wing),tip:_e(n.colours.wing_tip)},s=Xv(n);s.forEach(r=>Ef(t,n,r,i));for(let r of[{reach:.5,start:.75,up:.01,many:15,shade:.97},{reach:.28,start:.35,up:.018,many:18,shade:1.03}])qv(n,s,r).forEach(o=>Ef(t,n,o,i));return $v(t,n,ye(i.wing,1.05),Math.min(.12*e,n.body.width*.4)),{sheet:t,held:[0,1],hollow:0}}function vl(n,t){let e=wh(n);return t<n.wrist?.4-.14*t/n.wrist:.26*Math.max(1-((t-n.wrist)/(e-n.wrist))**2,0)}function wh({wrist:n}){return n+.5*(1-n)}function Xv(n){let{wrist:t,semiSpan:e}=n,i=[],s=ae(.02,t,Math.max(Math.round(Vv*t),5)),r=(s[1]-s[0])*e;for(let l of[.3,.13]){let c=-l*n.body.width/e,h=[c,-(.94-.3*l)*n.behind(0)];i.push({base:[c,n.at(0,.3)],tip:h,half:.13*n.body.width,hand:0,follow:0,round:.3})}s.forEach((l,c)=>{let h=Math.max(l-.02*(c/s.length),0);i.push({base:[h,n.at(h,.8*vl(n,h))],tip:[l,-n.behind(l)],half:.95*r,hand:0,follow:0,round:.18})});let o=n.outline(t,Sf),a=o.map((l,c)=>{let h=c?o[c-1]:[t,-n.behind(t)];return Math.hypot((l[0]-h[0])*e,l[1]-h[1])});return o.forEach((l,c)=>{let h=(c+1)/Sf,u=t+(wh(n)-t)*h**1.2;i.push({base:[u,n.at(u,.6*vl(n,u)+.06)],tip:l,half:.95*a[c],hand:h,follow:h**3,round:.26})}),i}function qv(n,t,{reach:e,start:i,up:s,many:r,shade:o}){return Array.from({length:r},(a,l)=>{let c=l/(r-1)*(t.length-1.0001),h=Math.floor(c),u=b=>[0,1].map(S=>{let[w,E]=[t[h][b][S],t[h+1][b][S]];return w+(c-h)*(E-w)}),[d,f]=[u("base"),u("tip")],p=[d[0],n.at(d[0],i*vl(n,d[0]))],_=t[h].hand,g=e*(1-.35*_),m=[0,1].map(b=>d[b]+g*(f[b]-d[b]));return{base:p,tip:m,half:.75*n.semiSpan*.9/r,hand:.55*_,follow:t[h].follow,round:.35,along:Wv,shade:o,up:s}})}function Ef(n,t,e,i){let{base:s,tip:r,hand:o,follow:a,round:l,along:c,up:h=0,shade:u=1}=e,{semiSpan:d}=t,f=w=>[s[1]+w*(r[1]-s[1]),(s[0]+w*(r[0]-s[0]))*d],p=w=>Math.min(e.half,.3*t.chord(f(w)[1]/d)),_=w=>{let E=f(w)[1]/d,T=(t.ahead(E+.02)-t.ahead(E-.02))/(.04*d);return t.ahead(E)-gf(w,p,l)*Math.hypot(1,T)},g=[_(0)-s[1],_(1)-r[1]],S=ul({path:w=>{let[E,T]=f(w);return[E+a*(_(w)-(1-w)*g[0]-w*g[1]-E),T]},half:p,round:l,tint:w=>{let E=Math.max(o*_i(w,.05,.7),.35*_i(w,.75,1));return ye(ze(i.wing,i.tip,E),u)},...c&&{along:c}},(w,E,T,x,M)=>{let D=Math.max(E[1]/d,0),P=E[0]+T[0],U=h*t.chord(Math.min(D,.8))*Math.min(2*w,1);return n.add(D,P,t.height(D,E[0])+U+x,T[1]+Math.min(E[1],0),M)});n.grid(S)}function $v(n,t,e,i){let s=wh(t),r=[...ae(1,0,yl),...ae(0,1,yl).slice(1)],o=(a,l)=>{let[c,h]=[vl(t,a),t.chord(a)],u=t.thickness*h*(1+.8*Math.exp(-a/.06))*Math.min(3*(1-a/s)+.15,1);return r.map((d,f)=>{let p=c*d*d,_=t.at(a,p),g=1.3*u*d*(1-d**3)*(f<yl?.62:-.42);return n.add(a,_,t.height(a,_)+g,l,ye(e,f<yl?1:1.12))})};n.grid([o(0,-i),...ae(0,s,11).map(a=>o(a,0))])}function Mn(n,t,e,i,s,{around:r=5,from:o}={}){let{semiSpan:a}=t,l=e.map(([c,h,u],d)=>{let[f,p]=[e[Math.max(d-1,0)],e[Math.min(d+1,e.length-1)]],[_,g]=[p[1]-f[1],(p[0]-f[0])*a],m=Math.hypot(_,g)||1;return Array.from({length:r+1},(b,S)=>{let w=2*Math.PI*S/r,[E,T]=[i[d]*Math.cos(w),i[d]*Math.sin(w)];return n.add(c,h+g/m*E,u+T,-_/m*E,s)})});if(o){let[c,h,u]=e[0],d=l[0].map(()=>n.add(c,h,u,0,s));for(let f of d)n.hold(f,o);l.unshift(d)}n.grid(l.map(c=>c.reverse()))}var Af=[.2,.4,.6,.8],Yv=7,Rf=.07;function Cf(n){let[t,e]=[new yi,new yi],{semiSpan:i}=n,s=_e(n.colours.wing),r=[0,...Af,1],o=r.slice(1).flatMap((_,g)=>ae(r[g],_,5).slice(g?1:0));t.grid(o.map(_=>{let{behind:g,share:m}=n.edge(_,r,Rf),[b,S]=[n.ahead(_),-g];return ae(0,1,Yv).map(w=>{let E=S+w*(b-S);return t.add(_,E,n.height(_,E),0,ye(s,1+.08*m*(1-m)*4))})}));let a=ye(_e(n.colours.back),.7),l=.008*i,c=(_,g)=>{let m=n.at(_,g);return[_,m,n.height(_,m)]},h=ae(0,1,11),{width:u,depth:d}=n.body,f=[.5*n.ahead(0),.2*u,.05*d];Mn(e,n,h.map(_=>c(_,.01)),h.map(_=>l*(1.5-_)),a,{from:f});let p=ae(0,1,9);Mn(e,n,p.map(_=>c(.72*_,.05+.6*(1-_)**1.5)),p.map(()=>.5*l),a,{from:[-.3*n.behind(0),.1*u,0]});for(let _ of Af){let g=ae(0,1,5);Mn(e,n,g.map(m=>c(_,.01+.98*m)),g.map(()=>.4*l),a)}return{sheet:t,bones:e,held:r,hollow:Rf}}var Pf=9,If=.19;function Lf(n){let t=new yi,e=new yi,{wrist:i,semiSpan:s,body:r}=n,o=Zv(n),a={wing:_e(n.colours.wing),tip:_e(n.colours.wing_tip)},l=[0,...o.map(([p])=>p)];Jv(t,n,l,a);let c=ze(a.wing,_e(n.colours.breast),.22),h=.009*s,u=(p,_,g=.25)=>{let m=n.at(p,_);return[p,m,n.height(p,m)+g*h]},d=u(i,.04);Mn(e,n,[u(0,.25),u(.5*i,.36),d],[1.5*h,1.2*h,.9*h],c,{from:[.1*r.length,.2*r.width,.1*r.depth]});for(let[p,_]of o){let g=p===1,m=ae(0,1,6).map(b=>{let S=i+b*(p-i),w=d[1]+b*(_-d[1])+.05*b*(1-b)*s,E=g?n.at(S,.03):w;return[S,E,n.height(S,E)+.25*h*(1-b)]});Mn(e,n,m,ae(.75*h,.18*h,6),c)}let f=[d,[i+.025,d[1]+.045*s,d[2]+h]];return Mn(e,n,f,[.6*h,.2*h],c),Kv(t,n,r),{sheet:t,bones:e,held:l,hollow:If}}function Zv(n){let{wrist:t}=n;return[t+.06*(1-t),t+.52*(1-t),1].map(e=>[e,-n.behind(e)])}function Jv(n,t,e,i){let r=e.slice(1).flatMap((o,a)=>ae(e[a],o,8).slice(a?1:0)).map(o=>{let{behind:a,share:l}=t.edge(o,e,If),[c,h]=[t.ahead(o),-a];return ae(0,1,Pf).map(u=>{let d=h+u*(c-h),f=1-.07*Math.cos(2*Math.PI*l)-.05*Math.cos(9*Math.PI*u)*(1-u),p=.02*t.chord(o)*4*l*(1-l)*(1-u)*2*u,_=ye(ze(i.wing,i.tip,.8*o),f);return n.add(o,d,t.height(o,d)+p,0,_)})});n.grid(r),n.root=r[0]}function Kv(n,t,e){let i=_h(e);n.root.forEach((s,r)=>{let o=r/(Pf-1),a=i[0]+o*(Math.min(t.ahead(0),.3*e.length)-i[0]),l=Math.min(Math.max((a+.5*e.length)/e.length,0),1),c=.42*e.width*Math.sqrt(Math.max(4*l*(1-l),0)),h=Math.max(1-o/.35,0);n.hold(s,[a,c+(i[1]-c)*h,.05*e.depth*o])})}var bl=class{constructor(t,e){Object.assign(this,t,{semiSpan:e})}ahead(t){return Df(this.leading,t)}behind(t){return Df(this.trailing,t)}chord(t){return this.ahead(t)+this.behind(t)}at(t,e){return this.ahead(t)-e*this.chord(t)}edge(t,e,i){let s=Math.max(e.findIndex(l=>l>=t-1e-9),1),r=(t-e[s-1])/(e[s]-e[s-1]),o=(e[s]-e[s-1])*this.semiSpan,a=Math.min(4*i*o*r*(1-r),.45*this.chord(t));return{behind:this.behind(t)-a,share:r}}height(t,e){let i=this.chord(t);if(i<=0)return 0;let s=Math.min(Math.max((this.ahead(t)-e)/i,0),1);return 4*this.camber*i*s*(1-s)}outline(t,e){let i=[];for(let o=0;o<=400;o++){let a=t+(1-t)*o/400;i.push([a,-this.behind(a)])}i.push([1,this.ahead(1)]);let s=[0];for(let o=1;o<i.length;o++){let[a,l]=[i[o-1],i[o]];s.push(s[o-1]+Math.hypot((l[0]-a[0])*this.semiSpan,l[1]-a[1]))}let r=s.at(-1);return Array.from({length:e},(o,a)=>{let l=(a+1)/e*r,c=Math.max(s.findIndex(u=>u>=l*(1-1e-12)),1),h=Math.min((l-s[c-1])/(s[c]-s[c-1]||1),1);return[0,1].map(u=>i[c-1][u]+h*(i[c][u]-i[c-1][u]))})}};function Df(n,t){let e=Math.min(Math.max(t,0),1)*(n.length-1),i=Math.min(Math.floor(e),n.length-2);return n[i]+(e-i)*(n[i+1]-n[i])}var jv={feathers:Tf,membrane:Lf,film:Cf},Qv={feathers:1,membrane:.93,film:.62},tb=.28,wl=class{constructor(t,e){let{cover:i}=t.shape;this.frame=new Zn(t.strips),this.planform=new bl(t.shape,t.semi_span),this.group=new ge;let{sheet:s,bones:r,held:o,hollow:a}=jv[i](this.planform);this.skins=[[s,Qv[i]],[r,1]].filter(([l])=>l).map(([l,c])=>({skin:new Vr(l,Hr(c*e)),opacity:c*e}));for(let{skin:l}of this.skins)this.group.add(...l.meshes);e===1&&this.addShadow(o,a)}addShadow(t,e){let i=new yi,s=new Pt(0);i.grid(ae(0,1,33).map(r=>[-this.planform.edge(r,t,e).behind,this.planform.ahead(r)].map(a=>i.add(r,a,0,0,s)))),this.shade=new Vr(i,Hr(1));for(let r of this.shade.meshes)r.layers.set(Gr);this.group.add(...this.shade.meshes)}show(t,e){this.frame.set(t);for(let{skin:i}of this.skins)i.show(this.frame,e);this.shade?.show(this.frame,e)}fade(t){if(t!==this.faded){this.faded=t;for(let{skin:e,opacity:i}of this.skins)for(let{material:s}of e.meshes)s.opacity=t?tb*i:i,s.transparent=s.opacity<1,s.depthWrite=!t&&i>.5,s.needsUpdate=!0}}};var eb={left:1,right:-1},Wr=class{constructor(t,e){this.flight=t,this.group=new ge,this.still=new ge,this.group.add(this.still),this.strips=Object.fromEntries(Object.entries(eb).map(([i,s])=>[i,new pl(t.strips,s,e)])),this.arrows=Object.fromEntries(Object.entries(Kr).map(([i,s])=>[i,new hl(t.strips,s,e)])),this.body=new fl(t,e),this.wings=new wl(t,e),this.trails=new ml(t,e),this.still.add(this.body.group,this.wings.group,...Object.values(this.strips).map(i=>i.mesh)),this.still.add(...Object.values(this.arrows).map(i=>i.group)),this.wake=new xl(t,e),this.group.add(this.trails.group,this.wake.group),this.buffers={corners:new Float64Array(t.strips*12),vectors:new Float64Array(t.strips*3),tint:new Float64Array(t.strips)}}show(t,e){let{flight:i,buffers:s}=this,r=i.locate(t),[o,a]=i.pivot(t,r);this.group.position.set(-o,e.offset,-a),this.still.position.set(i.number("x",r),0,i.number("z",r));let l=i.number("body_pitch",r);this.body.show(l),i.read("corners",r,s.corners),this.wings.show(s.corners,l),this.wings.fade(e.strips),i.read(e.colour,r,s.tint);for(let c of Object.values(this.strips))c.show(s.corners,s.tint,e.range),c.mesh.visible=e.strips;for(let[c,h]of Object.entries(this.arrows))h.group.visible=e.arrows.has(c)&&c in i.arrays,h.group.visible&&h.show(i.read(c,r,s.vectors),s.corners,e);this.trails.group.visible=e.trails,e.trails&&this.trails.show(t,e.tipForce),this.wake.group.visible=e.wake,e.wake&&this.wake.show(t,e.floor)}tint(t){for(let e of Object.values(this.strips))e.edges.material.color.set(t);this.trails.tint(t),this.wake.tint(Qr(t))}drawn(t){let{geometry:e}=this.strips[t].mesh,i=this.still.position;return{corners:Array.from(e.getAttribute("position").array,(r,o)=>r+[i.x,i.y,i.z][o%3]),normals:Array.from(e.getAttribute("normal").array)}}skinPoints(t){let e=this.still.position.toArray();return t.map(([i,s])=>this.wings.frame.place(i,s,0).map((r,o)=>r+e[o]))}dispose(){this.group.traverse(t=>{t.geometry?.dispose(),t.material?.dispose()})}};var Mh=24,Nf={light:{zenith:"#bcd5ec",haze:"#eef1ee",soil:"#d3cfba"},dark:{zenith:"#0a1220",haze:"#2b3947",soil:"#161c1a"}},ib=`
uniform float horizon, pitch, halfway, above, clearness;
uniform vec3 zenith, haze, soil;
varying vec3 colour;
void main() {
  float split = clamp(horizon, -1.0, 1.0);
  float share = position.y * position.y;
  float row = position.y > 0.0 ? mix(split, 1.0, share) : mix(split, -1.0, share);
  float angle = pitch + atan(row * halfway);
  vec3 sky = mix(haze, zenith, smoothstep(0.0, 0.55, angle));
  float far = above / max(sin(-angle), 1e-4);
  float clear = 0.22 + 0.78 * exp(-pow(max(far, 0.0) / clearness, 1.2));
  bool ground = above > 0.0 && (position.z > 0.5 || horizon > 1.0) && horizon > -1.0;
  colour = ground ? mix(haze, soil, clear) : sky;
  gl_Position = vec4(position.x, row, 1.0, 1.0);
}`,nb=`
varying vec3 colour;
void main() {
  gl_FragColor = vec4(colour, 1.0);
}`,Ml=class{constructor(){let t=Object.keys(Nf.light).map(r=>[r,{value:new N}]),e=["horizon","pitch","halfway","above","clearness"].map(r=>[r,{value:0}]),i=new Xe({vertexShader:ib,fragmentShader:nb,uniforms:Object.fromEntries([...t,...e]),side:Me,depthTest:!1,depthWrite:!1});this.mesh=new de(sb(),i),this.mesh.frustumCulled=!1,this.mesh.renderOrder=-2;let s=new N;this.mesh.onBeforeRender=(r,o,a)=>{let{uniforms:l}=i;a.getWorldDirection(s);let c=Math.asin(Math.min(Math.max(s.z,-1),1)),h=Math.tan(a.fov*Math.PI/360);l.pitch.value=c,l.halfway.value=h,l.horizon.value=-Math.tan(c)/h,l.above.value=a.position.z-this.height,i.uniformsNeedUpdate=!0}}fit(t,e){this.height=t,this.mesh.material.uniforms.clearness.value=e}tint(t){for(let[e,i]of Object.entries(Nf[t])){let{r:s,g:r,b:o}=new Pt(i).getRGB({},xe);this.mesh.material.uniforms[e].value.set(s,r,o)}}dispose(){this.mesh.geometry.dispose(),this.mesh.material.dispose()}};function sb(){let n=[],t=[];for(let i of[1,0]){let s=n.length/3;for(let r=0;r<=Mh;r++){let o=(i?-1:1)*(r/Mh);n.push(-1,o,i,1,o,i)}for(let r=0;r<Mh;r++){let[o,a]=[s+2*r,s+2*r+2];t.push(o,o+1,a,a,o+1,a+1)}}let e=new ue;return e.setAttribute("position",new Jt(n,3)),e.setIndex(t),e}var[Jn,Uf]=[24,4],Of=8,rb=800,ob=-1.15,ab={light:"#57543f",dark:"#a9bdb2"},lb=`
attribute float passes, strength, spacing;
uniform float passed, passing, reach, sight;
varying float seen;
void main() {
  vec3 at = position;
  if (passes > 0.0) at.x = mod(at.x - passed + reach, 2.0 * reach) - reach;
  vec4 world = modelMatrix * vec4(at, 1.0);
  float edge = 1.0 - smoothstep(0.4 * reach, 0.95 * reach, length(at.xy));
  float blurred = passes * smoothstep(0.2, 0.6, passing / spacing);
  seen = strength * edge * exp(-distance(world.xyz, cameraPosition) / sight) * (1.0 - blurred);
  gl_Position = projectionMatrix * viewMatrix * world;
}`,cb=`
uniform vec3 line;
varying float seen;
void main() {
  gl_FragColor = vec4(line, seen);
}`,Sl=class{constructor(){let t={passed:0,passing:0,reach:Jn,sight:1};this.backdrop=new Ml;let e=new Xe({vertexShader:lb,fragmentShader:cb,uniforms:{...Object.fromEntries(Object.entries(t).map(([i,s])=>[i,{value:s}])),line:{value:new N}},transparent:!0,depthWrite:!1});this.lines=new On(hb(),e),this.lines.frustumCulled=!1,this.lines.renderOrder=-1,this.group=new ge,this.group.add(this.backdrop.mesh,this.lines)}fit(t){this.cell=nn(.3*t),this.height=ob*t,this.lines.scale.setScalar(this.cell),this.lines.position.z=this.height,this.lines.material.uniforms.sight.value=5*t,this.backdrop.fit(this.height,11*t)}show(t,e){this.passed=t;let{uniforms:i}=this.lines.material,s=t/this.cell;i.passed.value=s-2*Jn*Math.floor(s/(2*Jn)),i.passing.value=e/this.cell}tint(t){let{r:e,g:i,b:s}=new Pt(ab[t]).getRGB({},xe);this.lines.material.uniforms.line.value.set(e,i,s),this.backdrop.tint(t)}dispose(){this.lines.geometry.dispose(),this.lines.material.dispose(),this.backdrop.dispose()}};function hb(){let n={position:[],passes:[],strength:[],spacing:[]},t=(s,r,o,a,l)=>{n.position.push(...s,...r),n.passes.push(o,o),n.strength.push(...a),n.spacing.push(l,l)};for(let s=-Jn;s<Jn;s++){let r=s%Uf===0,o=r?[.6,.6]:[.24,.24];for(let a=0;a<Of;a++){let[l,c]=[a,a+1].map(h=>Jn*(2*h/Of-1));t([l,s,0],[c,s,0],0,o,1),t([s,l,0],[s,c,0],1,o,r?Uf:1)}}let e=ub(7);for(let s=0;s<rb;s++){let[r,o]=[e(),e()].map(h=>Jn*.6*(2*h-1)),[a,l,c]=[.1*(e()-.5),.1*(e()-.5),.06+.12*e()];t([r/.6,o,0],[r/.6+a,o+l,c],1,[.75,.25],4)}let i=new ue;for(let[s,r]of Object.entries(n))i.setAttribute(s,new Jt(r,r.length/n.passes.length));return i}function ub(n){let t=n;return()=>{t=t+1831565813|0;let e=Math.imul(t^t>>>15,1|t);return e=e+Math.imul(e^e>>>7,61|e)^e,((e^e>>>14)>>>0)/2**32}}var Os={oblique:[2.3,2.5,.8],side:[0,-4,0],front:[4,0,0],top:[-.001,0,4.2],following:[-3,0,1]},db=.32,El=class{constructor(t,e){this.renderer=new rl({canvas:t,antialias:!0,alpha:!0}),this.scene=new fr,this.camera=new Ye(32,1,.01,1e3),this.camera.up.set(0,0,1),this.controls=new cl(this.camera,t),this.controls.enablePan=!1,this.controls.addEventListener("change",()=>this.draw()),this.sky=new Er(16054271,11049606);let i=new Ar(16774370,2.4);i.position.set(.9,1.4,4),this.scene.add(this.sky,i),this.shadow=new dl(this.scene),this.ground=new Sl,this.scene.add(this.ground.group),this.animals=[],this.body=new N,this.follows=!1,this.setFlights(e),this.setCamera("oblique")}setFlights(t){for(let s of this.animals)this.scene.remove(s.group),s.dispose();this.animals=t.map(s=>new Wr(s,1));for(let s of this.animals)this.scene.add(s.group);let e=Math.max(...t.map(s=>s.semi_span)),i=e!==this.span;this.span=e,this.ground.fit(e),this.ink&&this.tint(this.ink),i&&this.view&&this.setCamera(this.view)}arrange(t){let[e,i]=this.animals;if(!i)return;this.scene.remove(i.group),i.dispose(),this.animals[1]=new Wr(i.flight,t?db:1),this.scene.add(this.animals[1].group);let s=t?0:1.25*this.span;this.offsets=new Map([[e,s],[this.animals[1],-s]]),this.spread=t?1:1.75,this.tint(this.ink),this.setCamera(this.view)}show(t,e){let i=e.ground?[this.ground.height,.5*this.span]:void 0;for(let u of this.animals)u.show(t,{...e,floor:i,offset:this.offsets?.get(u)??0});let s=this.animals[0].flight,r=s.locate(t),[o,a]=s.pivot(t,r);this.ground.group.visible=e.ground;let l=e.still?0:s.advance;this.ground.show(e.still?0:o+e.laps*l,e.passing*l/s.last);let c=new N(s.number("x",r)-o,0,s.number("z",r)-a);if(this.follows){let u=c.clone().sub(this.body);this.camera.position.add(u),this.controls.target.add(u),this.controls.update()}this.body.copy(c);let h=this.offsets?2*Math.max(...this.offsets.values()):0;this.shadow.place(c,this.ground.height,this.span,h),this.shadow.ground.visible=e.ground,this.draw()}setCamera(t){this.view=t,this.follows=t==="following";let e=this.follows?this.body:new N,i=this.span*(this.spread??1)*Math.max(1,1.15/(this.camera.aspect||1));this.controls.target.copy(e),this.camera.position.copy(e).addScaledVector(new N(...Os[t]),i),this.controls.update(),this.draw()}tint(t){this.ink=t;for(let i of this.animals)i.tint(t);let e=Qr(t);this.ground.tint(e),this.shadow.tint(e),this.sky.intensity=e==="dark"?2.4:1.7,this.draw()}resize(t,e){let i=this.camera.aspect;this.renderer.setPixelRatio(Math.min(window.devicePixelRatio,2)),this.renderer.setSize(t,e,!1),this.camera.aspect=t/e,this.camera.updateProjectionMatrix(),Math.abs(i-this.camera.aspect)>.1&&this.setCamera(this.view),this.draw()}draw(){this.due??=requestAnimationFrame(()=>{this.due=void 0,this.shadow.draw(this.renderer),this.renderer.render(this.scene,this.camera),this.onDraw?.()})}get perMetre(){return nu(this.camera,this.controls.target,this.renderer.domElement.clientHeight)}dispose(){cancelAnimationFrame(this.due);for(let t of this.animals)t.dispose();this.ground.dispose(),this.shadow.dispose(),this.controls.dispose(),this.renderer.dispose(),this.renderer.forceContextLoss()}};var Ff=`.wb-plots {
  display: grid;
  grid-template-columns: repeat(auto-fill, minmax(min(280px, 100%), 1fr));
  gap: 14px 16px;
}
.wb-board {
  display: grid;
  gap: 8px;
}
.wb-card {
  min-width: 0;
}
.wb-row,
.wb-foot {
  display: flex;
  align-items: center;
  gap: 4px;
  min-width: 0;
}
.wb-rows select {
  font-weight: 600;
}
/* Menus look like the labels that they are, until one points at them. */
.wb-viewer .wb-card select,
.wb-viewer .wb-card button {
  background-color: transparent;
  border-color: transparent;
  min-height: 26px;
  padding: 1px 3px;
  font-size: 12px;
}
.wb-viewer .wb-card select {
  flex: 0 1 auto;
  min-width: 0;
  max-width: 100%;
  text-overflow: ellipsis;
}
.wb-viewer .wb-card select:hover,
.wb-viewer .wb-card button:hover {
  border-color: var(--line);
  background-color: var(--shade);
}
.wb-viewer .wb-card button {
  color: var(--soft);
  padding: 1px 6px;
}
.wb-viewer .wb-card .wb-faint {
  color: var(--soft);
  font-weight: 400;
}
.wb-viewer .wb-card option,
.wb-viewer .wb-card optgroup {
  color: var(--ink);
  background: var(--paper);
}
.wb-key {
  flex: 0 0 14px;
  height: 3px;
  border-radius: 2px;
  margin-left: 4px;
}
.wb-key-0 {
  background: var(--curve-0);
}
.wb-key-1 {
  background: var(--curve-1);
}
.wb-value {
  flex: 1 0 auto;
  margin-left: auto;
  text-align: right;
  font-variant-numeric: tabular-nums;
  font-size: 13px;
}
.wb-against {
  color: var(--soft);
  font-size: 12px;
  margin-left: 4px;
}
.wb-foot {
  flex-wrap: wrap;
  justify-content: end;
}
.wb-across {
  flex: 1 1 120px;
}
/* Against a series, its name and value have the line for themselves. */
.wb-across:has(.wb-value:not(:empty)) {
  flex-basis: 100%;
}
.wb-foot button {
  flex: none;
}
/* One plot stays. */
.wb-card:only-child .wb-foot button:last-child {
  display: none;
}
.wb-plot {
  border-radius: 4px;
}
.wb-plots svg {
  display: block;
  width: 100%;
  height: auto;
  cursor: crosshair;
  touch-action: pan-y;
  user-select: none;
}
.wb-viewer text {
  fill: var(--ink);
  font-size: 11px;
}
.wb-viewer .wb-tick,
.wb-viewer .wb-unit {
  fill: var(--soft);
  font-size: 10px;
}
.wb-downstroke {
  fill: var(--shade);
}
.wb-grid,
.wb-zero {
  stroke: var(--line);
  stroke-width: 0.6;
}
.wb-zero {
  stroke: var(--soft);
}
.wb-axis {
  fill: transparent;
  cursor: ew-resize;
}
.wb-range {
  fill: var(--accent);
  opacity: 0.22;
  pointer-events: none;
}
.wb-curve {
  fill: none;
  stroke-width: 1.8;
  stroke-linejoin: round;
}
.wb-thick {
  stroke-width: 4.5;
  stroke-linecap: round;
  opacity: 0.4;
}
.wb-curve-0 {
  stroke: var(--curve-0);
}
.wb-curve-1 {
  stroke: var(--curve-1);
}
.wb-flight-1:not(.wb-thick) {
  stroke-dasharray: 5 3;
}
.wb-dot {
  stroke: var(--paper);
  stroke-width: 1;
}
.wb-dot-0 {
  fill: var(--curve-0);
}
.wb-dot-1 {
  fill: var(--curve-1);
}
/* The second flight's dots are rings. */
.wb-dot.wb-at-1 {
  fill: var(--paper);
  stroke-width: 1.6;
}
.wb-dot-0.wb-at-1 {
  stroke: var(--curve-0);
}
.wb-dot-1.wb-at-1 {
  stroke: var(--curve-1);
}
.wb-start {
  fill: none;
  stroke: var(--soft);
  stroke-width: 1.2;
}
.wb-cursor {
  stroke: var(--ink);
  stroke-width: 1;
}
.wb-note {
  margin: 0;
  color: var(--soft);
  font-size: 12px;
}
.wb-own {
  stroke: light-dark(#7a2e8f, #d9a3ea);
  stroke-width: 2;
  stroke-dasharray: 7 4;
}
`;var Fs=om(Jf(),1);/*! GIFs are written by gifenc 1.0.3, copyright 2017 Matt DesLauriers, MIT license */var[Ub,Ob]=[48,12],Kf=20,Fb=2,Bb=[{type:"video/mp4;codecs=avc1.42E01F",ending:"mp4",name:"MP4"},{type:"video/webm;codecs=vp9",ending:"webm",name:"WebM"},{type:"video/webm",ending:"webm",name:"WebM"}];function jf(){let n=Bb.filter(({type:t})=>window.MediaRecorder?.isTypeSupported(t)&&HTMLCanvasElement.prototype.captureStream);return n.filter(({ending:t},e)=>n.findIndex(i=>i.ending===t)===e)}var Cl=class{constructor(t,e){this.viewer=t;let{clientWidth:i,clientHeight:s}=t.picture;this.ratio=e/i,this.canvas=document.createElement("canvas"),this.canvas.width=e,this.canvas.height=2*Math.round(.5*e*s/i),this.pen=this.canvas.getContext("2d",{willReadFrequently:!0}),this.before={phase:t.phase,playing:t.playing},t.pause();let{renderer:r,camera:o}=t.stage;r.setPixelRatio(1),r.setSize(e,this.canvas.height,!1),o.aspect=e/this.canvas.height,o.updateProjectionMatrix()}paint(t){let{viewer:e,pen:i,canvas:s}=this,{stage:r}=e;e.set(t),r.renderer.render(r.scene,r.camera),i.setTransform(1,0,0,1,0,0),i.fillStyle=getComputedStyle(e.root).backgroundColor,i.fillRect(0,0,s.width,s.height),i.drawImage(e.canvas,0,0,s.width,s.height),this.write()}write(){let{viewer:t,pen:e,canvas:i}=this,s=Math.max(.024*i.width,10);e.fillStyle=getComputedStyle(t.root).color,e.font=`${s}px system-ui, sans-serif`,e.textBaseline="top",[...t.heading.querySelectorAll("p")].map(o=>o.textContent).forEach((o,a)=>e.fillText(o,s,s*(.8+1.4*a),i.width-2*s)),e.textBaseline="alphabetic",e.textAlign="right",e.fillText(t.readout.textContent,i.width-s,i.height-s),e.textAlign="left",t.legend.querySelector(".wb-gradient")?.checkVisibility()&&this.scale(s)}scale(t){let{viewer:e,pen:i,canvas:s}=this,[r,o,a]=[t,s.height-4.4*t,12*t];for(let u=0;u<1;u+=.01)i.fillStyle=`rgb(${jr(2*u-1,1).map(d=>Math.round(255*d)).join(" ")})`,i.fillRect(r+u*a,o,.015*a,.8*t);i.fillStyle=getComputedStyle(e.root).color;let[l,c,h]=[...e.legend.querySelectorAll(".wb-ends span")].map(u=>u.textContent);i.fillText(l,r,o+2*t),i.textAlign="center",i.fillText(c,r+.5*a,o+2*t),i.textAlign="right",i.fillText(h,r+a,o+2*t),i.textAlign="left",i.fillText(e.legend.querySelector(".wb-ends").nextElementSibling?.textContent??"",r,o+3.4*t)}end(){this.viewer.resize(),this.viewer.set(this.before.phase),this.before.playing&&this.viewer.play()}};function Qf({phase:n,last:t,rate:e,flights:i}){let s=Math.max(Math.min(Math.floor(n),t-1),0),r=Math.min(s+1,t);return{from:s,to:r,seconds:(r-s)/(i[0].frequency*e)}}var kb=()=>new Promise(n=>setTimeout(n));async function tp(n,t,e,i){let{from:s,to:r,seconds:o}=Qf(n),a=Math.max(Math.min(Ub,Math.floor(1e3*o/Kf)),Ob),l=Math.max(Math.round(1e3*o/a),Kf),c=new Cl(n,t),{canvas:h,pen:u}=c,d=f=>(c.paint(s+(r-s)*f/a),u.getImageData(0,0,h.width,h.height).data);try{let f=[0,1,2,3].flatMap(g=>zb(d(g*a/4))),p=(0,Fs.quantize)(new Uint8Array(f),256),_=(0,Fs.GIFEncoder)();for(let g=0;g<a;g++){i.throwIfAborted();let m=g?{}:{palette:p,repeat:0};_.writeFrame((0,Fs.applyPalette)(d(g),p),h.width,h.height,{delay:l,...m}),e((g+1)/a),await kb()}return _.finish(),{blob:new Blob([_.bytes()],{type:"image/gif"}),frames:a,width:t,height:h.height}}finally{c.end()}}function zb(n){let t=[];for(let e=0;e<n.length;e+=52)t.push(n[e],n[e+1],n[e+2],255);return t}async function ep(n,t,{type:e},i,s){let{from:r,to:o,seconds:a}=Qf(n),l=a*Math.ceil(Fb/a),c=new Cl(n,t);try{c.paint(r);let h=new MediaRecorder(c.canvas.captureStream(),{mimeType:e,videoBitsPerSecond:8e6}),u=[];h.addEventListener("dataavailable",p=>u.push(p.data));let d=new Promise((p,_)=>{h.addEventListener("stop",p),h.addEventListener("error",g=>_(g.error))});h.start();let f=performance.now();for(let p=0;p<l&&!s.aborted;p=.001*(performance.now()-f))c.paint(r+p/a%1*(o-r)),i(p/l),await new Promise(_=>requestAnimationFrame(_));return h.stop(),await d,s.throwIfAborted(),{blob:new Blob(u,{type:e.split(";")[0]}),seconds:l,width:t,height:c.canvas.height}}finally{c.end()}}var ip="wb",Rh=(n,t=4)=>Array.from(n,e=>Number(e.toPrecision(t))).join(",");function Ch(n,t){let e=(n??"").split(",").map(Number);return n&&e.length===t&&e.every(Number.isFinite)?e:void 0}function np(n){return[...n.root.querySelectorAll("[data-choice]")].map(t=>{let e=t.type==="checkbox",i=e?String(t.defaultChecked):[...t.options].find(s=>s.defaultSelected)?.value;return{control:t,isBox:e,name:t.dataset.choice,normal:i,value:e?String(t.checked):t.value}})}function qr(n){let{stage:t,plots:e}=n,i=new URLSearchParams({[ip]:"1",phase:Rh([n.phase],6),camera:t.view});i.set("eye",Rh(t.camera.position.clone().sub(t.controls.target).divideScalar(t.span).toArray(),5));for(let{name:s,value:r,normal:o}of np(n))r!==o&&i.set(`set.${s}`,r);return JSON.stringify(e.choices)!==JSON.stringify(e.first)&&i.set("plots",e.choices.map(({ys:s,x:r})=>`${s.join(".")}~${r}`).join("*")),(e.range[0]>0||e.range[1]<e.last)&&i.set("zoom",Rh(e.range,6)),i.toString().replaceAll("%2C",",").replaceAll("%7E","~")}function Hb({control:n,isBox:t,value:e,normal:i},s=i){if(!(s===void 0||s===e)){if(t)n.checked=s==="true";else if([...n.options].some(r=>r.value===s))n.value=s;else return;n.dispatchEvent(new Event("change"))}}function sp(n,t){let e=new URLSearchParams(t);if(e.get(ip)!=="1")return;n.pause();for(let l of np(n))Hb(l,e.get(`set.${l.name}`)??void 0);let i=e.get("plots")?.split("*").map(l=>{let[c,h]=l.split("~");return{ys:c.split("."),x:h??Le}});n.plots.choose(i??n.plots.first);let{last:s}=n.plots,[r,o]=Ch(e.get("zoom"),2)??[0,s];n.plots.zoom(r>=0&&r<o&&o<=s?[r,o]:[0,s]);let a=e.get("camera");Object.hasOwn(Os,a??"")&&n.setCamera(a),n.setEye(Ch(e.get("eye"),3)),n.set(Ch(e.get("phase"),1)?.[0]??0)}var Gb=[320,480,640,960],rp=n=>n<1e6?`${Math.round(n/1e3)} kB`:`${(n/1e6).toFixed(1)} MB`,Pl=class{constructor(t,{address:e,script:i}={}){Object.assign(this,{viewer:t,address:e,script:i}),this.told=R("output",{class:"wb-note wb-told"});let s=R("summary",{},"Share");this.element=R("details",{class:"wb-share",ontoggle:()=>this.refresh()},s,R("div",{class:"wb-share-parts"},...this.links(),this.moving(),...this.file()),this.told),this.element.addEventListener("keydown",r=>r.key!=="Escape"&&r.stopPropagation()),this.element.addEventListener("keydown",r=>{r.key!=="Escape"||!this.element.open||(this.element.open=!1,s.focus())})}tell(t){this.told.textContent=t}part(t,...e){return R("fieldset",{class:"wb-part"},R("legend",{},t),...e)}button(t,e){return R("button",{type:"button",onclick:e},t)}links(){if(!this.address)return[];this.link=R("input",{type:"text",readonly:!0,"aria-label":"Link to what is shown"}),this.frame=R("textarea",{readonly:!0,rows:3,"aria-label":"Code that shows this page in another"});let t=location.protocol==="file:";return[this.part("Link",this.link,this.button("Copy link",()=>this.copy(this.link,"the link")),R("p",{class:"wb-note"},t?"It opens this file on this computer.":"It opens this phase, camera and choice of plots.")),this.part("Frame for another page",this.frame,this.button("Copy code",()=>this.copy(this.frame,"the code")),R("p",{class:"wb-note"},t?"Put this file beside the other page.":"The frame loads when a reader comes near."))]}refresh(){if(!this.address||!this.element.open)return;this.link.value=this.address(qr(this.viewer));let t=location.protocol==="file:"?this.link.value.slice(this.link.value.lastIndexOf("/")+1):this.link.value,e=R("iframe",{src:t,title:`Flight of ${this.label}`,width:960,height:640,loading:"lazy",style:"border: 0"});this.frame.value=e.outerHTML}get label(){return this.viewer.flights.map(t=>t.label).join(" and ")}async copy(t,e){this.refresh();try{await navigator.clipboard.writeText(t.value),this.tell(`Copied ${e}.`)}catch{t.select(),this.tell(`The browser does not allow to copy ${e} by itself; it is selected: press Ctrl+C or Cmd+C.`)}}moving(){let t=[{name:"GIF",ending:"gif"},...jf()],e=`${this.viewer.id}-share`,i=R("select",{id:`${e}-kind`},...t.map(({name:c})=>R("option",{value:c},c))),s=R("select",{id:`${e}-width`});for(let c of Gb)s.append(R("option",{value:c,selected:c===640},`${c} px`));let r=R("progress",{max:1,value:0,"aria-label":"Progress of the moving picture",hidden:!0}),o=this.button("Save",()=>{this.work?this.work.abort():this.make(t.find(({name:c})=>c===i.value),Number(s.value),r,o)}),l=`One beat at the chosen speed; a video lasts at least 2 s. ${t.length===1?"This browser cannot record a canvas, so there is no video here.":""}`;return this.part("Moving picture",R("span",{class:"wb-choice"},R("label",{for:i.id},"Format"),i),R("span",{class:"wb-choice"},R("label",{for:s.id},"Width"),s),o,r,R("p",{class:"wb-note"},l))}async make(t,e,i,s){this.work=new AbortController,s.textContent="Stop",i.hidden=!1,this.tell("");let r=o=>i.value=o;try{let{signal:o}=this.work,a=t.type?await ep(this.viewer,e,t,r,o):await tp(this.viewer,e,r,o),l=qs(this.label,t.ending);oo(a.blob,l);let c=a.frames?`${a.frames} frames`:`${a.seconds.toPrecision(2)} s`;this.tell(`Saved ${l}: ${a.width} x ${a.height} pixels, ${c}, ${rp(a.blob.size)}.`)}catch(o){this.tell(o.name==="AbortError"?"Stopped.":`The browser could not make it: ${o.message}`)}finally{this.work=void 0,s.textContent="Save",i.hidden=!0}}file(){return this.script?[this.part("One file",this.button("Save this page",()=>this.savePage()),R("p",{class:"wb-note"},"It flies offline, and opens as it is shown now."))]:[]}savePage(){this.script.dataset.state=qr(this.viewer);let t=document.documentElement.cloneNode(!0);for(let s of t.querySelectorAll(".wb-viewer"))s.remove();let e=`<!doctype html>
${t.outerHTML}
`,i=qs(this.label,"html");oo(new Blob([e],{type:"text/html"}),i),this.tell(`Saved ${i}, ${rp(e.length)}.`)}};var op=`.wb-share summary {
  display: inline-block;
  list-style: none;
  background: var(--shade);
  border: 1px solid var(--line);
  border-radius: 6px;
  padding: 3px 12px;
  min-height: 30px;
  cursor: pointer;
}
.wb-share summary::-webkit-details-marker {
  display: none;
}
.wb-share summary:hover,
.wb-share[open] summary {
  border-color: var(--accent);
}
.wb-share[open] {
  flex: 1 0 100%;
}
.wb-share-parts {
  display: grid;
  grid-template-columns: repeat(auto-fit, minmax(min(250px, 100%), 1fr));
  gap: 10px;
  margin-top: 8px;
}
.wb-part {
  display: flex;
  flex-wrap: wrap;
  align-items: center;
  align-content: start;
  gap: 8px 12px;
  border: 1px solid var(--line);
  border-radius: 8px;
  margin: 0;
  padding: 4px 12px 10px;
  min-width: 0;
}
.wb-part legend {
  padding: 0 4px;
  font-weight: 600;
}
.wb-part .wb-note {
  flex: 1 1 100%;
}
.wb-part input,
.wb-part textarea {
  flex: 1 1 100%;
  min-width: 0;
  font: 12px/1.4 ui-monospace, monospace;
  color: var(--ink);
  background: var(--paper);
  border: 1px solid var(--line);
  border-radius: 6px;
  padding: 5px 8px;
  resize: vertical;
}
.wb-part progress {
  flex: 1 1 100%;
  width: 100%;
  height: 8px;
  accent-color: var(--accent);
}
.wb-told {
  display: block;
  margin-top: 6px;
  min-height: 1.4em;
}
`;var ap=`.wb-viewer {
  color-scheme: light dark;
  --ink: light-dark(#1c2128, #e6e9ee);
  --paper: light-dark(#ffffff, #14181d);
  --soft: light-dark(#5b6470, #a4adb8);
  --line: light-dark(#d0d5db, #3a424c);
  --shade: light-dark(#eceff3, #232a32);
  --accent: light-dark(#0b5cad, #6db3f2);
  --curve-0: light-dark(#0072b2, #56b4e9);
  --curve-1: light-dark(#b84300, #ff9a5c);
  color: var(--ink);
  background: var(--paper);
  font: 14px/1.4 system-ui, sans-serif;
  display: flex;
  flex-wrap: wrap;
  gap: 12px;
  padding: 10px;
  border-radius: 8px;
  box-sizing: border-box;
}
.wb-viewer[data-theme="light"] {
  color-scheme: light;
}
.wb-viewer[data-theme="dark"] {
  color-scheme: dark;
}
.wb-viewer *,
.wb-viewer *::before {
  box-sizing: border-box;
}
.wb-viewer:focus-visible,
.wb-viewer :focus-visible {
  outline: 2px solid var(--accent);
  outline-offset: 2px;
}
.wb-viewer [hidden] {
  display: none;
}
.wb-bar {
  display: flex;
  flex-wrap: wrap;
  align-items: center;
  gap: 8px 18px;
}
.wb-group {
  display: flex;
  flex-wrap: wrap;
  align-items: center;
  gap: 4px 10px;
  border: 0;
  margin: 0;
  padding: 0;
}
.wb-group legend {
  float: left;
  padding: 0;
  color: var(--soft);
}
.wb-push {
  border: 1px solid var(--line);
  border-radius: 8px;
  margin: 0;
  padding: 4px 12px 8px;
}
.wb-push legend {
  padding: 0 4px;
  font-weight: 600;
}
.wb-viewer button,
.wb-viewer select {
  font: inherit;
  color: var(--ink);
  background: var(--shade);
  border: 1px solid var(--line);
  border-radius: 6px;
  padding: 3px 10px;
  min-height: 30px;
  cursor: pointer;
}
.wb-viewer button:hover {
  border-color: var(--accent);
}
.wb-viewer button[aria-pressed="true"] {
  border-color: var(--accent);
  color: var(--accent);
}
.wb-choice,
.wb-toggle {
  display: inline-flex;
  align-items: center;
  gap: 6px;
}
.wb-choice label {
  color: var(--soft);
}
.wb-viewer input {
  accent-color: var(--accent);
}
.wb-swatch {
  width: 12px;
  height: 12px;
  border-radius: 3px;
}
.wb-stage {
  display: flex;
  flex-direction: column;
  gap: 8px;
  flex: 1000 1 480px;
  min-width: 0;
  container-type: inline-size;
}
.wb-side {
  flex: 1 1 300px;
  min-width: 0;
}
.wb-frame {
  position: relative;
  flex: 1 1 auto;
  display: flex;
  flex-direction: column;
}
.wb-folded {
  flex: 1 1 100%;
}
.wb-folded summary {
  color: var(--soft);
  cursor: pointer;
  padding: 4px 0;
}
.wb-folded .wb-bar,
.wb-folded .wb-side {
  margin-top: 8px;
}
.wb-viewer[data-compact] .wb-heading {
  display: none;
}
.wb-picture {
  position: relative;
  flex: 1 1 auto;
  aspect-ratio: 4 / 3;
  max-height: 76vh;
  min-height: 280px;
  border: 1px solid var(--line);
  border-radius: 8px;
  overflow: hidden;
}
.wb-canvas {
  position: absolute;
  inset: 0;
  width: 100%;
  height: 100%;
  touch-action: none;
}
.wb-heading {
  position: absolute;
  top: 8px;
  left: 12px;
  right: 12px;
  pointer-events: none;
}
.wb-heading p {
  margin: 0;
}
.wb-legends {
  position: absolute;
  left: 12px;
  right: 12px;
  bottom: 10px;
  display: flex;
  justify-content: space-between;
  align-items: flex-end;
  gap: 16px;
  font-size: 12px;
  pointer-events: none;
}
.wb-heading,
.wb-legends {
  text-shadow: 0 0 3px var(--paper), 0 0 3px var(--paper);
}
.wb-scale {
  width: 170px;
}
.wb-measures {
  width: 200px;
  text-align: right;
}
.wb-bar-line {
  height: 7px;
  margin-left: auto;
  border: 2px solid var(--ink);
  border-top: 0;
}
.wb-gradient {
  height: 10px;
  border-radius: 3px;
}
.wb-ends {
  display: flex;
  justify-content: space-between;
  font-variant-numeric: tabular-nums;
}
.wb-player input[type="range"] {
  flex: 1 1 160px;
  min-width: 120px;
}
.wb-readout {
  font-variant-numeric: tabular-nums;
  min-width: 11.5em;
}
/* In a narrow picture the legends would cover the animal: they stand below it. */
@container (max-width: 480px) {
  .wb-legends {
    position: static;
    align-items: flex-start;
    padding-top: 6px;
  }
}
`;var lp=[[1,"real time"],[.25,"1/4 speed"],[.1,"1/10 speed"],[.03,"1/30 speed"]],cp={alpha:{label:"effective angle of attack",unit:"deg",scale:180/Math.PI,most:Math.PI/3},strip_lift:{label:"lift of a strip",unit:"N",scale:1,most:1/0}},Xb={trails:"trails",ground:"ground",wake:"wake (a sketch, not computed)"},qb={lift:"lift",drag:"drag",force:"resultant"},$b=0,hp=n=>n.toLowerCase().replace(/\W+/g,"-"),Bs=class{constructor(t,e,{theme:i="system",playing:s=!0,compact:r=!1,share:o={}}={}){this.id=`wb${++$b}`,this.look={strips:!1,colour:"alpha",arrows:new Set(["force"])},Object.assign(this.look,{trails:!0,ground:!0,wake:!1,laps:0}),this.calm=window.matchMedia("(prefers-reduced-motion: reduce)").matches,this.look.still=this.calm,this.rate=.1,this.ghost=!0,this.phase=0,this.frame=0,this.root=R("section",{class:"wb-viewer","aria-label":"Wingbeat viewer",tabindex:"0"}),this.root.append(R("style",{},ap+Ff+op)),this.root.viewer=this,this.canvas=R("canvas",{class:"wb-canvas",role:"img"}),this.share=new Pl(this,o),this.build(),r&&this.fold(),t.append(this.root),this.root.addEventListener("keydown",a=>this.key(a)),this.setTheme(i),this.media=window.matchMedia("(prefers-color-scheme: dark)"),this.onTheme=()=>this.tint(),this.media.addEventListener("change",this.onTheme),this.replace(e),this.watcher=new ResizeObserver(()=>this.resize()),this.watcher.observe(this.picture),s&&!this.calm&&this.play()}build(){let t=(f,p,_)=>R("button",{type:"button","aria-label":p,title:p,onclick:_},f);this.playButton=t("\u25B6","Play (space)",()=>this.playing?this.pause():this.play()),this.scrubber=R("input",{type:"range",min:0,step:"any","aria-label":"Phase of the beat",oninput:()=>{this.pause(),this.set(Number(this.scrubber.value))}}),this.readout=R("output",{class:"wb-readout"}),this.rates=this.choice("Speed",lp,this.rate,f=>this.rate=Number(f)),this.cameras=Object.keys(Os).map((f,p)=>R("button",{type:"button","aria-pressed":"false",title:`${f} view (${p+1})`,onclick:()=>this.setCamera(f)},f));let e=[["off","off"],...Object.entries(cp).map(([f,{label:p}])=>[f,p])],i=Object.entries(qb).map(([f,p])=>this.toggle(p,this.look.arrows.has(f),Kr[f],_=>{this.look.arrows[_?"add":"delete"](f),this.set(this.phase)})),[s,r,o]=Object.entries(Xb).map(([f,p])=>this.toggle(p,this.look[f],null,_=>{this.look[f]=_,this.measure(),this.set(this.phase)}));this.wakeToggle=o,this.pairing=this.choice("Two flights",[["ghost","second as ghost"],["beside","side by side"]],"ghost",f=>{this.ghost=f==="ghost",this.arrange()}),this.theme=this.choice("Theme",[["system","as system"],["light","light"],["dark","dark"]],"system",f=>this.setTheme(f)),this.heading=R("div",{class:"wb-heading"}),this.legend=R("div",{class:"wb-scale"}),this.measures=new Vs,this.picture=R("div",{class:"wb-picture"},this.canvas,this.heading);let a=R("div",{class:"wb-legends"},this.legend,this.measures.element),l=R("div",{class:"wb-frame"},this.picture,a);this.side=R("div",{class:"wb-side"});let c=this.choice("Strips",e,"off",f=>{this.look.strips=f!=="off",this.look.strips&&(this.look.colour=f),this.scaleTint(),this.set(this.phase)});this.pushes=new lo(this.id,(f,p)=>this.demonstrate(f,p));let h=R("div",{class:"wb-group",role:"group","aria-label":"Camera"},...this.cameras),u=R("fieldset",{class:"wb-group"},R("legend",{},"Air"),s,r,o),d=R("fieldset",{class:"wb-group"},R("legend",{},"Forces"),...i);this.root.append(R("div",{class:"wb-stage"},R("div",{class:"wb-bar"},h),l,R("div",{class:"wb-bar wb-player"},this.playButton,this.scrubber,this.readout,this.rates),R("div",{class:"wb-bar"},c,d,u,this.pairing,this.theme,this.share.element),this.pushes.element),this.side)}fold(){let t=this.root.querySelectorAll(".wb-bar:not(.wb-player, .wb-push)"),e=R("details",{class:"wb-folded"},R("summary",{},"Views, forces and plots"),...t,this.side);this.theme.remove(),this.rates.querySelector("label").textContent="Playback",this.root.dataset.compact="",this.root.append(e)}choice(t,e,i,s){let r=`${this.id}-${t.replace(/\W/g,"")}`,o=R("select",{id:r,"data-choice":hp(t),onchange:()=>s(o.value)});for(let[a,l]of e)o.append(R("option",{value:a,selected:a===i},l));return R("span",{class:"wb-choice"},R("label",{for:r},t),o)}toggle(t,e,i,s){let r=R("input",{type:"checkbox",checked:e,"data-choice":hp(t),onchange:()=>s(r.checked)}),o=i?[R("span",{class:"wb-swatch",style:`background:${i}`,"aria-hidden":"true"})]:[];return R("label",{class:"wb-toggle"},r,...o,t)}key(t){if(t.target.matches("select")||t.ctrlKey||t.metaKey||t.altKey)return;let e=(t.shiftKey?.05:.01)*(t.key==="ArrowLeft"?-1:1),i=Object.keys(Os)[Number(t.key)-1];if(t.key===" "&&!t.target.matches("button, input[type=checkbox]"))this.playing?this.pause():this.play();else if(t.key==="ArrowLeft"||t.key==="ArrowRight")this.step(e);else if(t.key==="Home"||t.key==="End")this.step(t.key==="Home"?-this.phase:this.last-this.phase);else if(i)this.setCamera(i);else return;t.preventDefault()}replace(t){this.pushes.offer(t),this.show(t)}demonstrate(t,e){let{playing:i}=this;this.pause(),this.once=e,this.show(t),this.set(0),(i||e&&!this.calm)&&this.play()}show(t){this.flights=t.flights.map(r=>new to(r)),this.last=Math.min(...this.flights.map(r=>r.last)),this.scrubber.max=this.last,this.stage?this.stage.setFlights(this.flights):this.makeStage(),this.stage.onDraw=()=>this.measures.follow(this.stage,this.look,this.flights[0]),this.pairing.hidden=this.flights.length<2,this.wakeToggle.hidden=!this.flights.some(r=>r.wake),this.wakeToggle.hidden&&(this.look.wake=this.wakeToggle.querySelector("input").checked=!1),this.look.laps=0,this.look.tipForce=Vs.tipForce(this.flights);let e=JSON.stringify(t.panels)===this.panels?this.plots:void 0;this.panels=JSON.stringify(t.panels),this.plots=new ao(t,this.flights,this.last,r=>{this.pause(),this.set(r)}),this.plots.choose(e?.choices??[]),e?.last===this.last&&this.plots.zoom(e.range),this.plots.overlay(this.overlaid??[]),this.side.replaceChildren(this.plots.element);let i=this.flights.map(r=>`${r.label}: ${r.summary}`);this.heading.replaceChildren(...(i.length>1?i:[this.flights[0].summary]).map(r=>R("p",{},r))),this.canvas.setAttribute("aria-label",`Animation of ${this.flights.map(r=>r.label).join(" and ")}`);let s=Math.max(...this.flights.map(r=>r.largest("force",3)));this.look.scale=s>0?.55*this.stage.span/s:0,this.look.thickness=.009*this.stage.span,this.scaleTint(),this.measure(),this.tint(),this.arrange(),this.setCamera(this.stage.view),this.set(Math.min(this.phase,this.last))}overlay(t){this.overlaid=t;let e=this.plots.overlay(t);return this.plots.include(e),e.length&&this.side.closest("details")?.setAttribute("open",""),e}makeStage(){this.stage=new El(this.canvas,this.flights),this.stage.controls.addEventListener("start",()=>this.eye=void 0)}arrange(){this.stage.arrange(this.ghost),this.set(this.phase)}scaleTint(){let{label:t,unit:e,scale:i,most:s}=cp[this.look.colour],r=Math.max(...this.flights.map(c=>c.largest(this.look.colour)),1e-12),o=nn(Math.min(r,s)*i,[1,1.5,2,3,4,5,6,8,10]);this.look.range=o/i;let a=[R("div",{class:"wb-gradient",style:`background:${eu()}`}),R("div",{class:"wb-ends"},...[-o,0,o].map(c=>R("span",{},Pi(c)))),R("div",{},`${t} [${e}]`)],l=this.flights.some(c=>c.shape.schematic);this.legend.replaceChildren(...this.look.strips?a:[],...l?[R("div",{},"shape of the animal: schematic")]:[])}measure(){this.measures.show(this.look,this.flights[0],this.stage.ground.cell)}setCamera(t){this.eye=void 0,this.stage.setCamera(t);for(let e of this.cameras)e.setAttribute("aria-pressed",String(e.textContent===t))}setEye(t){if(this.eye=t,!t)return;let{camera:e,controls:i,span:s}=this.stage;e.position.set(...t).multiplyScalar(s).add(i.target),i.update()}setBeat(t){let e=([s])=>Math.abs(Math.log(t*s*this.flights[0].frequency)),[i]=lp.reduce((s,r)=>e(r)<e(s)?r:s);this.rate=i,this.rates.querySelector("select").value=i}setTheme(t){this.root.dataset.theme=t,this.stage&&this.tint()}tint(){this.stage.tint(getComputedStyle(this.root).color)}resize(){let{clientWidth:t,clientHeight:e}=this.picture;t&&e&&this.stage.resize(t,e),this.setEye(this.eye)}get playing(){return this.clock!==void 0}set(t,e=0){this.look.passing=e,this.phase=Math.min(Math.max(t,0),this.last),this.frame+=1,this.stage.show(this.phase,this.look),this.plots.show(this.phase),this.scrubber.value=this.phase;let i=this.flights[0].locate(this.phase),s=1e3*this.flights[0].number("time",i);this.readout.textContent=`phase ${this.phase.toFixed(3)}, ${s.toFixed(1)} ms`}step(t){this.pause(),this.set(this.phase+t)}play(){if(this.playing)return;this.once&&this.phase>=this.last&&this.set(0);let t=performance.now(),e=i=>{let s=(i-t)*.001*this.rate*this.flights[0].frequency;t=i;let r=this.phase+Math.max(s,0);if(this.once||(this.look.laps+=Math.floor(r/this.last)),this.set(this.once?r:r%this.last,s),this.once&&this.phase>=this.last)return this.pause();this.clock=requestAnimationFrame(e)};this.clock=requestAnimationFrame(e),this.playButton.textContent="\u275A\u275A",this.playButton.setAttribute("aria-label","Pause (space)")}pause(){cancelAnimationFrame(this.clock),this.clock=void 0,this.look.passing&&this.set(this.phase),this.playButton.textContent="\u25B6",this.playButton.setAttribute("aria-label","Play (space)")}get state(){return qr(this)}restore(t){sp(this,t)}drawn(t=0,e="left"){return this.stage.animals[t].drawn(e)}skinPoints(t,e=0){return this.stage.animals[e].skinPoints(t)}corners(t=0,e="left"){return this.drawn(t,e).corners}destroy(){this.pause(),this.watcher.disconnect(),this.media.removeEventListener("change",this.onTheme),this.stage.dispose(),this.root.remove()}};function me(n,t=3){return Number(n.toPrecision(t)).toString()}function Qi(n,t,e=3){return t?`${me(n,e)} ${t}`:me(n,e)}function ks(n){return Array.isArray(n)?n:[n,n]}function up(n){return n.certified?`certified, ${n.plausible?"plausible":"not plausible"}`:"no certified wingbeat"}var ne={left:46,right:16,top:14,bottom:38};function Ph(n,t,e){let i=nn((t-n)/e),s=Math.ceil(n/i-1e-9),r=Math.floor(t/i+1e-9);return Array.from({length:r-s+1},(o,a)=>Number(((s+a)*i).toPrecision(12)))}function dp(n,t){let{x:e,y:i,width:s,height:r,xTicks:o,yTicks:a}=n,l=r-ne.bottom,c=(h,u,d,f,p="wbx-tick")=>Et("text",{x:h,y:u,"text-anchor":d,class:p},f);return Et("g",{"aria-hidden":"true"},...a.flatMap(h=>[Et("line",{class:"wbx-grid",x1:ne.left,x2:s-ne.right,y1:i(h),y2:i(h)}),c(ne.left-7,i(h)+4,"end",me(h))]),...o.map(h=>c(e(h),l+16,"middle",me(h))),Et("line",{class:"wbx-axis",x1:ne.left,x2:s-ne.right,y1:l,y2:l}),c(s-ne.right,l+31,"end","speed [m/s]"),c(ne.left+2,ne.top-3,"start",`${t.label} [${t.unit}]`))}function fp(n,{x:t,y:e},i){let s=[];for(let r=1;r<n.length;r++){let[o,a]=[n[r-1],n[r]];if(!o.certified||!a.certified)continue;let l=o.plausible&&a.plausible?"wbx-curve":"wbx-curve wbx-dashed",c={x1:t(o.speed),y1:e(o[i]),x2:t(a.speed),y2:e(a[i])};s.push(Et("line",{class:l,...c}))}return Et("g",{},...s)}function pp(n,{x:t,y:e,height:i},s){let r=n.map(o=>{let a=t(o.speed);return o.certified?Et("circle",{class:o.plausible?"wbx-dot":"wbx-dot wbx-hollow",cx:a,cy:e(o[s]),r:4}):Yb(a,i-ne.bottom-9)});return Et("g",{},...r)}function Yb(n,t){return Et("path",{class:"wbx-gap",d:`M${n-4} ${t-4}l8 8m0-8l-8 8`})}function mp(n,{x:t,y:e,height:i,width:s},r,o){let[a,l]=ks(n.speed).map(t),[c,h]=n[r]===void 0?[]:ks(n[r]).map(e),u=`${n.label}. Source: ${n.source}`,d={class:`wbx-measured wbx-${n.basis??"measured"}`,tabindex:"0",role:"img","aria-label":u,onpointerenter:()=>o(u),onpointerleave:()=>o(""),onfocus:()=>o(u),onblur:()=>o("")},f=h??ne.top,p=c??i-ne.bottom,_=Math.max(l-a,10),g=Math.max(p-f,10),b={x:Math.min((a+l-_)/2,s-ne.right-_),y:(f+p-g)/2,width:_,height:g,rx:3};return Et("g",d,Et("rect",b))}var Zb=400;function gp({title:n,points:t},e,{x:i,y:s,height:r},{name:o,unit:a},l){let c=t.filter(f=>f[o]!==void 0),h=c.length<=Zb,u=c.map(f=>{let[p,_]=[i(f.speed),s(f[o])],g=f[`${o}Error`],m=Math.min(s(f[o]-g),r-ne.bottom),b=g?[Et("path",{d:`M${p} ${s(f[o]+g)}V${m}`})]:[],S=Et("path",{class:"wbx-own-mark",d:`M${p} ${_-5}l5 5l-5 5l-5 -5z`});if(!h)return Et("g",{},...b,S);let w=`${f.label||n}: ${Qi(f[o],a)} at ${Qi(f.speed,"m/s")}.`;return Et("g",{onpointerenter:()=>l(w),onpointerleave:()=>l("")},...b,S)}),d=`${n}: ${c.length} measured points of your own`;return Et("g",{class:`wbx-own wbx-own-${e%3}`,role:"img","aria-label":d},...u)}var Il=[{name:"power",label:"Power",unit:"W"},{name:"frequency",label:"Wingbeats",unit:"Hz"}],Jb={ArrowRight:1,ArrowUp:1,ArrowLeft:-1,ArrowDown:-1,PageUp:3,PageDown:-3},Kb=.5,Ll=class{constructor(t,e){this.act=t,this.snap=e,this.quantity=Il[0],this.data={points:[],measured:[]},this.own=[],this.speed=0,this.svg=Et("svg",{class:"wbx-chart"}),this.buttons=Il.map(r=>R("button",{type:"button","aria-pressed":"false",onclick:()=>this.choose(r)},r.label));let i=R("div",{class:"wbx-pair",role:"group","aria-label":"Curve shown"},...this.buttons);this.note=R("p",{class:"wbx-note"});let s=R("div",{class:"wbx-row"},R("h2",{},"Drag the point to fly faster or slower"),i);this.element=R("div",{class:"wbx-curve-box","data-part":"curve"},s,this.svg,this.note),this.buildHandle(),this.svg.addEventListener("pointerdown",r=>this.take(r)),this.svg.addEventListener("pointermove",r=>this.dragging&&this.drag(r));for(let r of["pointerup","pointercancel"])this.svg.addEventListener(r,()=>this.release());this.watcher=new ResizeObserver(()=>this.draw()),this.watcher.observe(this.svg),this.choose(Il[0])}buildHandle(){this.guide=Et("line",{class:"wbx-guide"}),this.knob=Et("circle",{class:"wbx-knob",r:9}),this.tag=Et("text",{class:"wbx-tag","text-anchor":"middle"});let t={role:"slider",tabindex:"0","aria-label":"Speed","aria-orientation":"horizontal"};this.handle=Et("g",{class:"wbx-handle",...t},this.guide,this.knob,this.tag),this.handle.addEventListener("keydown",e=>this.key(e))}choose(t){this.quantity=t,this.buttons.forEach((e,i)=>e.setAttribute("aria-pressed",String(Il[i]===t))),this.draw()}show({points:t,measured:e=[],range:i}){this.data={points:[...t].sort((s,r)=>s.speed-r.speed),measured:e,range:i},this.draw()}showOwn(t){this.own=t,this.draw()}mark(t){this.dragging||(this.speed=t,this.place(t))}pin(t){this.pinned=t,this.draw()}draw(){let{clientWidth:t,clientHeight:e}=this.svg;if(!t||!e)return;let{name:i}=this.quantity,{points:s}=this.data,r=c=>i==="power"&&c.frequency===void 0,o=this.data.measured.filter(c=>c[i]!==void 0||r(c));this.scale=this.scales(t,e,o),this.svg.setAttribute("viewBox",`0 0 ${t} ${e}`);let a=c=>this.note.textContent=c||this.legend(o),l=document.activeElement===this.handle;this.svg.replaceChildren(dp(this.scale,this.quantity),...o.map(c=>mp(c,this.scale,i,a)),...this.own.map((c,h)=>gp(c,h,this.scale,this.quantity,a)),fp(s,this.scale,i),pp(s,this.scale,i),...this.drawPin(i),this.handle),l&&this.handle.focus(),a(""),this.place(this.speed)}scales(t,e,i){let{points:s}=this.data,{name:r}=this.quantity,o=[...s.map(x=>x.speed),...this.data.range??[]],[a,l]=o.length?[Math.min(...o),Math.max(...o)]:[0,20],c=this.own.flatMap(x=>x.points),h=c.map(x=>x.speed),u=[a,l,...i.flatMap(({speed:x})=>ks(x)),...h],d=Math.max(.04*(l-a),.2),[f,p]=[Math.max(Math.min(...u)-d,0),Math.max(...u)+d],_=s.filter(x=>x.certified).map(x=>x[r]),g=i.filter(x=>x[r]!==void 0).map(x=>ks(x[r])[1]),m=c.filter(x=>x[r]!==void 0).map(x=>x[r]),b=1.12*Math.max(..._,...g,...m,1e-9),S=x=>ne.left+(x-f)/(p-f)*(t-ne.left-ne.right),w=x=>e-ne.bottom-x/b*(e-ne.bottom-ne.top),E=x=>f+(x-ne.left)/(t-ne.left-ne.right)*(p-f),T=Ph(f,p,t<500?5:10);return{x:S,y:w,width:t,height:e,speedAt:E,first:a,last:l,xTicks:T,yTicks:Ph(0,b,4)}}drawPin(t){if(!this.pinned)return[];let{x:e,y:i}=this.scale,[s,r]=[e(this.pinned.speed),i(this.pinned[t])];return[Et("path",{class:"wbx-pin",d:`M${s} ${r-8}l8 8l-8 8l-8 -8z`})]}legend(t){let{points:e}=this.data,i=[];return e.some(s=>s.certified&&!s.plausible)&&i.push("dashed: not plausible"),e.some(s=>!s.certified)&&i.push("cross: no certified wingbeat"),t.length&&i.push("bars behind: real animals (point at one for its source)"),i.join("; ")}place(t){if(!this.scale)return;let{x:e,y:i,height:s,first:r,last:o}=this.scale,{name:a,unit:l}=this.quantity,c=e(Math.min(Math.max(t,r),o)),h=this.valueAt(t,a),u=s-ne.bottom,d=h===void 0?u-9:i(h);for(let[g,m]of Object.entries({x1:c,x2:c,y1:d,y2:u}))this.guide.setAttribute(g,m);this.knob.setAttribute("cx",c),this.knob.setAttribute("cy",d),this.tag.setAttribute("x",c),this.tag.setAttribute("y",d<ne.top+20?d+26:d-16);let f=this.nearest(t),p=f&&Math.abs(f.speed-t)<1e-9?f:void 0;this.tag.textContent=p?.certified&&!this.dragging?`${me(p[a])} ${l}`:"",this.handle.setAttribute("aria-valuemin",r),this.handle.setAttribute("aria-valuemax",o),this.handle.setAttribute("aria-valuenow",t);let _=p?.certified?`${me(p.power)} W, ${me(p.frequency)} Hz, `:"";this.handle.setAttribute("aria-valuetext",`${me(t)} m/s`+(p?`: ${_}${up(p)}`:""))}valueAt(t,e){let{points:i}=this.data,s=i.findIndex(l=>l.speed>=t-1e-9);if(s<0)return;let[r,o]=[i[s],i[s-1]];if(Math.abs(r.speed-t)<1e-9)return r.certified?r[e]:void 0;if(!o?.certified||!r.certified)return;let a=(t-o.speed)/(r.speed-o.speed);return o[e]+a*(r[e]-o[e])}nearest(t){let e=i=>Math.abs(i.speed-t);return this.data.points.reduce((i,s)=>i&&e(i)<=e(s)?i:s,void 0)}take(t){t.button!==0||!this.scale||(this.dragging=!0,this.svg.setPointerCapture(t.pointerId),this.handle.focus({preventScroll:!0}),this.drag(t))}drag(t){let{first:e,last:i,speedAt:s}=this.scale,r=t.clientX-this.svg.getBoundingClientRect().left,o=Math.min(Math.max(s(r),e),i);this.place(o),this.ask(this.snap?this.nearest(o)?.speed:Math.round(10*o)/10)}release(){this.dragging&&(this.dragging=!1,this.place(this.speed))}key(t){let e=Jb[t.key],i={Home:"first",End:"last"}[t.key];!e&&!i||t.ctrlKey||t.metaKey||t.altKey||!this.scale||(t.preventDefault(),t.stopPropagation(),i?this.ask(this.scale[i]):this.snap?this.ask(this.beside(e)):this.ask(Math.min(Math.max(this.speed+e*Kb,this.scale.first),this.scale.last)),this.place(this.speed))}beside(t){let{points:e}=this.data,i=e.indexOf(this.nearest(this.speed));return e[Math.min(Math.max(i+t,0),e.length-1)]?.speed}ask(t){t===void 0||t===this.speed||(this.speed=t,this.act(t))}destroy(){this.watcher.disconnect()}};var jb=2,Dl=class{constructor(){this.rows=new Map,this.element=R("ul",{class:"wbx-gauges","aria-label":"Numbers and their plausible ranges"})}show(t,e){let i=new Map((e??[]).map(s=>[s.name,s]));for(let s of t)this.rows.has(s.name)||this.rows.set(s.name,new Ih),this.rows.get(s.name).show(s,i.get(s.name));this.element.replaceChildren(...t.map(({name:s})=>this.rows.get(s).element))}},Ih=class{constructor(){this.label=R("span",{class:"wbx-label"}),this.value=R("span",{class:"wbx-value"}),this.word=R("span",{class:"wbx-word"}),this.band=R("span",{class:"wbx-band"}),this.mark=R("span",{class:"wbx-mark"}),this.pinned=R("span",{class:"wbx-mark wbx-was"}),this.bar=R("span",{class:"wbx-bar","aria-hidden":"true"},this.band,this.pinned,this.mark),this.range=R("p"),this.source=R("p");let t=R("summary",{},this.label,this.value,this.word,this.bar);this.element=R("li",{},R("details",{},t,this.range,this.source))}show(t,e){let{label:i,value:s,unit:r,low:o,high:a,source:l}=t,c=o!==null||a!==null;this.element.dataset.gauge=t.name,this.label.textContent=i,this.value.textContent=s===null?"\u2013":Qi(s,r),this.value.dataset.exact=s,this.word.textContent=Qb(t),this.element.className={true:"wbx-inside",false:"wbx-outside"}[t.inside]??"",this.range.textContent=c?`Plausible: ${tw(t)}`:"No plausible range is known.",this.source.textContent=c?`Source: ${l}`:"";let h=a!==null?jb*a:2.5*o,u=d=>`${100*Math.min(Math.max(d/h,0),1)}%`;this.bar.hidden=!c,c&&(this.band.style.left=u(o??0),this.band.style.right=`calc(100% - ${u(a??h)})`,this.put(this.mark,s,h,u),this.put(this.pinned,e?.value??null,h,u))}put(t,e,i,s){t.hidden=e===null,e!==null&&(t.style.left=s(e),t.classList.toggle("wbx-beyond",e>i))}};function Qb({value:n,low:t,high:e,inside:i}){return n===null?"not defined":t===null&&e===null?"no range known":i?"inside":e!==null&&n>e?"above":"below"}function tw({low:n,high:t,unit:e}){return n===null?`at most ${Qi(t,e)}`:t===null?`at least ${Qi(n,e)}`:`${Qi(n,"")} to ${Qi(t,e)}`}var Nl=class{constructor(){this.texts=[]}add(t){this.texts.includes(t)||this.texts.push(t)}get told(){let t=this.texts.length-8;return t<=0?this.texts:[...this.texts.slice(0,8),`and ${t} more like these`]}};function _p(n){if(!(n.size<=2e6))return`The file has ${(n.size/1e6).toFixed(1)} MB; at most ${2e6/1e6} MB are read.`}function yp(n,t){let e=n.replace(/^\uFEFF/,"").split(/\r\n|\r|\n/).map((a,l)=>({line:a,at:l+1})).filter(({line:a})=>a.trim()&&!a.startsWith("#"));if(e.length<2){t.add("The file has no rows: the first line names the columns, and each line below it is one row.");return}let i=["	",";",","].find(a=>e[0].line.includes(a))??",",s=xp(e[0].line,i),r=e.slice(1).map(({line:a,at:l})=>({at:l,cells:xp(a,i)}));r.length>5e3&&t.add(`The file has ${r.length} rows; at most 5000 are read.`);for(let{at:a,cells:l}of r.slice(0,5e3)){let[c,h]=[l.length,s.length];c!==h&&t.add(`Line ${a} has ${c} cells, the header has ${h}.`)}let o=/^#\s*frequency\s*(?:\[hz\])?\s*=\s*([\d.]+)/im.exec(n);return{header:s,rows:r.slice(0,5e3),frequency:o?Number(o[1]):void 0}}function xp(n,t){let e=[""],i=!1;for(let s=0;s<n.length;s++){let r=n[s];r==='"'&&i&&n[s+1]==='"'?e[e.length-1]+=n[++s]:r==='"'?i=!i:r===t&&!i?e.push(""):e[e.length-1]+=r}return e.map(s=>s.trim())}function vp(n){let t=/[[(]([^\])]*)[\])]/.exec(n),i=n.replace(/[[(].*$/,"").toLowerCase().trim().split(/[\s_-]+/).filter(Boolean);if(t)return{words:i,unit:t[1].trim().toLowerCase()};for(let[s,r]of ew){let o=i.slice(-s.length);if(i.length>s.length&&s.every((a,l)=>a===o[l]))return{words:i.slice(0,-s.length),unit:r}}return{words:i,unit:""}}var ew=[[["m","s"],"m/s"],[["m/s"],"m/s"],[["km","h"],"km/h"],[["mps"],"m/s"],[["hz"],"hz"],[["w"],"w"],[["mw"],"mw"],[["s"],"s"],[["ms"],"ms"],[["deg"],"deg"],[["degrees"],"deg"],[["rad"],"rad"]];function Ul(n,t,e,i,{low:s=-1/0,high:r=1/0}={}){if(n===void 0||/^(|na|n\/a|nan|-)$/i.test(n))return;if(/^[+-]?\d+,\d+$/.test(n))return i.add(`Line ${e}, ${t}: \u201C${n}\u201D has a decimal comma; write a decimal point.`),NaN;let o=/^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(n)?Number(n):NaN;if(!Number.isFinite(o))return i.add(`Line ${e}, ${t}: \u201C${n.slice(0,40)}\u201D is no number.`),NaN;if(o<s||o>r){let a=r===1/0?`at least ${s}`:`from ${s} to ${r}`;return i.add(`Line ${e}, ${t}: ${n} must be ${a}.`),NaN}return o}var iw=["speed","airspeed","velocity","v","u"],bp=["power","p"],wp=["frequency","freq","f","beats"],nw=["error","err","sd","se","sem","std","uncertainty"],sw=["label","name","animal","individual","species","source"],rw={speed:["m/s","ms-1","m s-1"],power:["w"],frequency:["hz","1/s","s-1"]},ow={speed:"m/s",power:"W",frequency:"Hz"},Lh=(n,t)=>t.includes(n.at(-1));function Mp(n){let t=n.map((r,o)=>({text:r,place:o,...vp(r)})),e=r=>r.words.some(o=>nw.includes(o)),i=t.find(r=>Lh(r.words,iw)&&!e(r));if(i)return{kind:"flights",columns:aw(t,i,e)};let s=t.find(r=>["phase","time","t"].includes(r.words[0])&&r.words.length===1);return s?{kind:"motion",clock:s,columns:t.filter(r=>r!==s)}:{kind:void 0}}function aw(n,t,e){let i={speed:t};i.power=n.find(s=>Lh(s.words,bp)&&!e(s)),i.frequency=n.find(s=>Lh(s.words,wp)&&!e(s));for(let s of n.filter(e)){let r=s.words.some(o=>wp.includes(o))?"frequency":s.words.some(o=>bp.includes(o))||i.power?"power":"frequency";i[`${r}Error`]??=s}return i.label=n.find(s=>s.words.some(r=>sw.includes(r))),i}function Sp({rows:n},t,e){for(let[r,o]of Object.entries(rw)){let a=t[r];a?.unit&&!o.includes(a.unit)&&e.add(`Column \u201C${a.text}\u201D is in ${a.unit}; convert it to ${ow[r]}.`)}!t.power&&!t.frequency&&e.add("No column is named power or frequency; at least one of them must stand beside the speed.");let i={speed:{low:0,high:200}},s=[];for(let{at:r,cells:o}of n){let a={label:o[t.label?.place]??""};for(let l of["speed","power","frequency","powerError","frequencyError"]){let c=t[l];c&&(a[l]=Ul(o[c.place],c.text,r,e,i[l]??{low:0}))}a.speed===void 0&&e.add(`Line ${r} has no speed.`),(a.power!==void 0||a.frequency!==void 0)&&s.push(a)}return!s.length&&!e.texts.length&&e.add("No row has a speed with a power or a frequency."),s}function Ep(n,t,e,i){let{rows:s}=n;s.length<3&&i.add("A wingbeat needs at least three rows.");let r=lw(n,t,i),o=r.map((l,c)=>c).sort((l,c)=>r[l]-r[c]),a=o.map(l=>r[l]);return e.map(l=>hw(l,o.map(c=>s[c]),a,i))}function lw({rows:n,frequency:t},e,i){let s=e.words[0]!=="phase",r=["","s","ms"].includes(e.unit);s&&!r&&i.add(`Column \u201C${e.text}\u201D must be in s or ms.`);let o=s?{}:{low:0,high:1},a=n.map(({at:u,cells:d})=>{let f=Ul(d[e.place],e.text,u,i,o);return f===void 0&&i.add(`Line ${u} has no ${s?"time":"phase"}.`),f});if(!s)return a;let[l,c]=[a[0],a.at(-1)];if(!t)return c>l||i.add(`Column \u201C${e.text}\u201D: the last time must be later than the first.`),a.map(u=>(u-l)/(c-l));let h=t*(e.unit==="ms"?.001:1);return a.map(u=>((u-l)*h%1+1)%1)}var cw=["flap","pitch","twist","fold","sweep","alpha"];function hw({text:n,words:t,unit:e,place:i},s,r,o){let a=t.some(u=>cw.includes(u)),l=["deg","degrees","\xB0"].includes(e);a&&!l&&e!=="rad"&&o.add(`Column \u201C${n}\u201D is an angle: name its unit, as in \u201C${t.join("_")}_deg\u201D.`);let c=l?Math.PI/180:1,h=s.map(({at:u,cells:d})=>{let f=Ul(d[i],n,u,o);return c*(f??NaN)});return{name:t.join("_"),title:n,phase:r,values:h}}var uw="A CSV file of measured flights has the columns speed [m/s] and power [W] or frequency [Hz], and may have error and label. A CSV file of a wingbeat has phase or time [s], and columns such as flap_deg or pitch_deg. With time, the rows are one beat from the first to the last, unless a line \u201C# frequency [Hz] = 8.2\u201D says how long a beat is.",dw="The first line must name the columns: speed with power or frequency, for measured flights; or phase or time with flap_deg and others, for a wingbeat.",fw="Drop a file anywhere on this page, or choose one. A CSV file stays in your browser: nothing of it is uploaded.",Ol=class{constructor(t){this.face=t,this.shown=[];let e={type:"file",multiple:!0,accept:".csv,.txt,.tsv,.toml"};this.input=R("input",{...e,onchange:()=>this.chosen()});let i=R("label",{class:"wbx-file"},R("span",{},"Choose a file"),this.input);this.list=R("ul",{class:"wbx-own-list"}),this.state=R("div",{class:"wbx-own-state",role:"status"}),this.element=R("section",{class:"wbx-own-data"},R("h2",{},"Your own data"),R("p",{},fw),i,this.list,this.state,R("details",{class:"wbx-more"},R("summary",{},"What the file must hold"),R("p",{},uw))),this.listen()}listen(){let t=new AbortController,e=o=>o.dataTransfer?.types.includes("Files"),{signal:i}=t,s=(o,a)=>document.addEventListener(o,l=>e(l)&&a(l),{signal:i}),r=o=>this.face.root.classList.toggle("wbx-dropping",o);s("dragover",o=>{o.preventDefault(),r(!0)}),s("dragleave",o=>o.relatedTarget===null&&r(!1)),s("drop",o=>{o.preventDefault(),r(!1),this.take([...o.dataTransfer.files])}),this.destroy=()=>t.abort()}chosen(){this.take([...this.input.files]),this.input.value=""}async take(t){this.state.replaceChildren();for(let e of t)await this.read(e)}async read(t){if(!/\.(csv|tsv|txt)$/i.test(t.name))return this.other(t);let e=new Nl,i=_p(t);i?e.add(i):this.interpret(t.name,await t.text(),e),e.texts.length&&this.refuse(t.name,e.told)}interpret(t,e,i){let s=yp(e,i);if(!s)return;let{kind:r,clock:o,columns:a}=Mp(s.header);r==="flights"?this.add({title:t,kind:r,points:Sp(s,a,i)},i):r==="motion"?this.add({title:t,kind:r,curves:Ep(s,o,a,i)},i):i.add(dw)}other(t){if(this.face.onfile)return this.face.onfile(t);if(!/\.toml$/i.test(t.name))return this.refuse(t.name,["Its name must end in .csv, or in .toml for a species file."]);let e=`wingbeat explore --static my-explorer --animals ${t.name}`,i=`${t.name} is a species file. Its flights must be solved, which this page cannot do.`;this.say(R("p",{},`${i} This command makes a page with them:`),R("code",{},e))}refuse(t,e){this.say(R("p",{},`${t} is not shown:`),R("ul",{},...e.map(i=>R("li",{},i))))}say(...t){this.state.append(...t)}add(t,e){e.texts.length||(this.shown=[...this.shown.filter(({title:i})=>i!==t.title),t],this.show())}remove(t){this.shown=this.shown.filter(e=>e!==t),this.show(),this.input.focus()}show(){let t=this.shown.filter(({kind:e})=>e==="flights");this.face.curve.showOwn(t),this.overlay(),this.list.replaceChildren(...this.shown.map(e=>this.row(e,t.indexOf(e))))}overlay(){let{viewer:t}=this.face,e=this.shown.flatMap(({title:i,curves:s=[]})=>s.map(r=>({...r,file:i})));this.drawn=t?.overlay(e)??[]}row(t,e){let i=e<0?"wbx-own-line":`wbx-own-${e%3}`,s=R("span",{class:`wbx-own-key ${i}`,"aria-hidden":"true"}),r={type:"button","aria-label":`Remove ${t.title}`},o=R("button",{...r,onclick:()=>this.remove(t)},"Remove");return R("li",{},s,R("span",{},this.words(t)),o)}words({title:t,points:e,curves:i}){if(e)return`${t}: ${e.length} ${e.length===1?"point":"points"} behind the curve`;let[s,r]=[!0,!1].map(a=>i.filter(({name:c})=>this.drawn.includes(c)===a).map(c=>c.title).join(", ")),o=r&&`; not drawn, because the plots have no such series: ${r}`;return s?`${t}: ${s} as dashed lines in the plots${o}`:`${t}${o}`}};var Fl=class{constructor(t){this.answer=void 0,this.ghost=!0,this.act=t,this.button=R("button",{type:"button",onclick:()=>this.toggle()}),this.way=R("button",{type:"button",onclick:()=>this.turn()}),this.words=R("p"),this.element=R("div",{class:"wbx-pins"},this.button,this.way,this.words),this.tell()}now(t){this.current=t,this.button.disabled=!t.scene&&!this.answer}toggle(){this.pin(this.answer?void 0:this.current)}pin(t){this.answer=t,this.tell(),this.act()}turn(){this.ghost=!this.ghost,this.tell(),this.act()}tell(){this.button.textContent=this.answer?"Remove the comparison":"Pin this flight to compare",this.way.textContent=this.ghost?"Show side by side":"Show as a ghost",this.way.hidden=this.words.hidden=!this.answer,this.words.textContent=this.answer?`Pinned: ${Tp(this.answer)}.`:""}scene(t){if(!this.answer)return t.scene;let[e,i]=[t,this.answer].map(s=>({...s.scene.flights[0],label:Tp(s)}));return{...t.scene,flights:[e,i]}}};function Tp({title:n,speed:t,model:e}){return`${n} at ${me(t)} m/s, model ${e}`}var Ap=`.wbx-push {
  align-self: start;
}
.wbx-extras {
  grid-column: 1 / -1;
  display: grid;
  grid-template-columns: minmax(0, 1fr) minmax(0, 1fr);
  gap: 24px 48px;
  padding-top: 18px;
  border-top: 1px solid var(--line);
}
.wbx-tours ul {
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
.wbx-own-data {
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
.wbx [data-part] {
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
@media (max-width: 899px) {
  .wbx-extras {
    order: 9;
    grid-template-columns: minmax(0, 1fr);
  }
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
  .wbx[data-tour] [data-part] {
    scroll-margin-bottom: 48vh;
  }
  .wbx[data-tour] {
    padding-bottom: 50vh;
  }
}
`;var Rp=`.wbx {
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
.wbx-say {
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
.wbx-sentence b {
  font-weight: 650;
  color: var(--accent);
  font-variant-numeric: tabular-nums;
  white-space: nowrap;
}
.wbx-choices {
  display: flex;
  flex-wrap: wrap;
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
  max-height: 7.6em;
  overflow: auto;
  padding-left: 1.1em;
  list-style: disc;
}
.wbx-stage {
  display: flex;
  flex-direction: column;
  gap: 10px;
  min-width: 0;
}
.wbx-picture {
  position: relative;
}
.wbx .wb-viewer {
  padding: 0;
  background: none;
  gap: 6px;
}
.wbx .wb-picture {
  aspect-ratio: auto;
  height: clamp(280px, calc(100vh - 500px), 680px);
  max-height: none;
  border: 0;
  border-radius: 14px;
  background: var(--shade);
}
.wbx[data-status]:not([data-status="converged"]) .wb-picture::after {
  content: "the closest wingbeat: it does not fly";
  position: absolute;
  left: 12px;
  top: 10px;
  padding: 2px 10px;
  border-radius: 20px;
  color: var(--paper);
  background: var(--bad);
  font-size: 13px;
}
.wbx-state:empty {
  display: none;
}
.wbx-row {
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
.wbx-side {
  grid-column: 2;
  grid-row: 1 / 3;
}
.wbx-judged {
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
@media (min-width: 600px) {
  .wbx-narrow {
    display: none;
  }
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
  .wbx-judged {
    order: 1;
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
    grid-template-columns: minmax(0, 1fr) auto;
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
  .wbx-row h2 {
    font-size: 13px;
  }
}
`;var ni=n=>`${me(n)} W`,si=n=>n.speed?`at ${me(n.speed)} m/s`:"in hover",Cp=n=>`${me(100*n,2)} %`;function Dh(n,t){let e=n.numbers.find(([i])=>i===t);return e&&[e[1],e[2]].filter(Boolean).join(" ")}function Nh(n,t){return n.gauges.find(e=>e.name===t&&e.value!==null)}var ci=(n,t)=>n?[t(n)]:[];function Ri(n,t,e=ni){let[i,s]=[e(n),e(t)];return i===s?`stays at ${s}`:`${t>n?"rises":"falls"} from ${i} to ${s}`}function Pp({spent:n},t){let e=Object.values(n).reduce((i,s)=>i+s,0);return n[t]/e}var gw=/(\d[\d.]*(?:e[+-]?\d+)? (?:m\/s|W\/kg|W|Hz|%|deg|g|m|beats?)(?![\w/]))/;function Ip(n){return n.split(gw).map((t,e)=>e%2?R("b",{},t):t)}var xw={profile:"profile power, the drag of the wings",induced:"induced power itself",parasite:"the drag of body and tail",unsteady:"that of rotation and added mass"};function Lp({spent:n}){let[t,e]=Object.entries(n).reduce((i,s)=>s[1]>i[1]?s:i);return`${xw[t]}, with ${ni(e)}`}function Dp({value:n,low:t,high:e,unit:i,inside:s}){let r=a=>[me(a),i].filter(Boolean).join(" ");if(s===null)return`${r(n)}; no plausible range is known`;if(s)return`${r(n)}, inside the plausible range`;let o=n>e?`at most ${r(e)}`:`at least ${r(t)}`;return`${r(n)}; plausible is ${o}`}var _w={upward:"from below",downward:"from above",head:"from ahead",tail:"from behind"};function Bl({direction:n,size:t}){return`a gust ${_w[n]} of up to ${me(t)} m/s`}var En=n=>`${me(n)} Hz`,Np=n=>`${me(n)} m`;function Tn(n){return n.charAt(0).toUpperCase()+n.slice(1)}function Up(n){let t=Nh(n,"flap_amplitude");return t?[`The wings flap ${me(t.value)} ${t.unit} to either side of their mean.`]:[]}function Op(n,t){return n>=t?"has enough for that":`would lack ${ni(t-n)}`}function Fp(n){let t=Dh(n,"a small disturbance");return t==="decays"?["A small disturbance decays."]:t==="grows"?["But a small disturbance grows, as long as the wingbeat does not react."]:[]}var $r={animal:"robofalcon2",model:["paper","animal"]},kp={name:"robot",title:"Build a robot",teaser:"From weight and span to a gait, and to what the motor must give.",steps:[{name:"weight",title:"Start from the weight",flight:{...$r,speed:"cheapest"},view:{camera:"front",arrows:!1},look:"picture",tell:({now:n,semiSpan:t})=>[`This ${n.title} has a mass of ${Dh(n,"mass")} and two wings of ${Np(t)} each.`,"Over a beat, the wings must carry the weight and balance the drag.","At its end, attitude and velocities of the body must be those of its beginning."]},{name:"gait",title:"Find a gait that closes",flight:{...$r,speed:"cheapest"},view:{camera:"side",arrows:!0},look:"picture",tell:({now:n})=>[`The solver looks for a wingbeat that repeats itself. It beats at ${En(n.frequency)} ${si(n)}.`,...Up(n),"Arrows show the air load on each strip of the wing."]},{name:"motor",title:"What the motor must give",flight:{...$r,speed:"cheapest"},view:{camera:"side",arrows:!0},look:"gauges",tell:({now:n})=>[`The hinges of the wings need ${ni(n.power)}: the mean over a beat, braking not counted.`,`That is ${ni(n.power/n.mass)} for each kilogram of the robot.`,"Gears and motor lose some of what they draw, so the battery must give more."]},{name:"slow",title:"Slow flight",flight:{...$r,speed:"slowest"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:n,seen:t})=>[`The slowest flight computed here, ${si(n)}, needs ${ni(n.power)}.`,...ci(t.gait,e=>`Against the cheapest flight the frequency ${Ri(e.frequency,n.frequency,En)}.`)]},{name:"fast",title:"Fast flight",flight:{...$r,speed:"fastest"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:n,seen:t})=>[`${Tn(si(n))} it needs ${ni(n.power)}.`,...ci(t.gait,({power:e})=>`A motor sized for the cheapest flight, with ${ni(e)}, ${Op(e,n.power)}.`),"For a robot of your own, write its numbers into a species file and drop it on this page."]}]},kl={animal:"pigeon",model:["paper","animal"],speed:"pushed"},Bp={direction:"tail",feedback:!1},zp={name:"tumbling",title:"Why it tumbles",teaser:"One gust, first with a fixed wingbeat, then with feedback.",steps:[{name:"orbit",title:"A flight that repeats itself",flight:kl,view:{camera:"side",arrows:!1},look:"picture",tell:({now:n})=>[`${Tn(si(n))} the pigeon flies a beat that ends as it began. Undisturbed, it would go on for ever.`,...Fp(n)]},{name:"free",title:"A gust, and a wingbeat that does not react",flight:kl,view:{camera:"side",arrows:!1},push:Bp,look:"picture",tell:({push:n})=>[`The pigeon meets ${Bl(n)}. Its wings go on beating as before.`,`It is ${n.outcome}.`]},{name:"held",title:"The same gust, with feedback",flight:kl,view:{camera:"side",arrows:!1},push:{...Bp,feedback:!0},look:"picture",tell:({push:n})=>[`Again ${Bl(n)}. Now feedback sees attitude and velocities once in each beat, and changes the wingbeat.`,`It is ${n.outcome}.`]},{name:"again",title:"Push it yourself",flight:kl,view:{camera:"side",arrows:!1},push:{direction:"upward",feedback:!1},look:"picture",tell:({push:n})=>[`Last, without feedback, ${Bl(n)}. It is ${n.outcome}.`,"Below the picture you can choose the gust yourself.","The feedback follows from the equations of motion; how birds do it is not modelled."]}]};var Gp={name:"hovering",title:"Why hovering costs",teaser:"A hummingbird slows down, and its power rises.",steps:[{name:"cheap",title:"The cheapest flight",flight:{animal:"annas-hummingbird",model:"animal",speed:"cheapest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:n})=>[`Of the speeds computed here, this hummingbird needs least power ${si(n)}: ${ni(n.power)}.`,"To stay up it must push air down. The downwash tilts the air loads back, and that costs induced power.",`It is ${ni(n.spent.induced)} here, ${Cp(Pp(n,"induced"))} of what is spent on the air.`]},{name:"slow",title:"Slower, with less air to push",flight:{animal:"annas-hummingbird",model:"animal",speed:"slow"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:n,seen:t})=>[`${Tn(si(n))} less air passes the wings in each second, and all of it must go down faster.`,...ci(t.cheap,e=>`Induced power ${Ri(e.spent.induced,n.spent.induced)}.`)]},{name:"hover",title:"No wind but its own",flight:{animal:"annas-hummingbird",model:"animal",speed:"slowest"},view:{camera:"oblique",arrows:!0},look:"curve",tell:({now:n,seen:t})=>[`${Tn(si(n))} the bird beats at ${En(n.frequency)}.`,...n.speed?[]:["What moves the air past its wings is their beat alone."],...ci(t.cheap,e=>`Against the cheapest flight, power ${Ri(e.power,n.power)}.`),`Of what is spent on the air, the largest part is ${Lp(n)}.`]},{name:"fast",title:"Fast flight",flight:{animal:"annas-hummingbird",model:"animal",speed:"fastest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:n,seen:t})=>[`${Tn(si(n))} air is plentiful, but it drags on body and wings.`,...ci(t.hover,e=>`Against the slowest flight, induced power ${Ri(e.spent.induced,n.spent.induced)}.`),...ci(t.hover,e=>`The power against the drag of body and tail ${Ri(e.spent.parasite,n.spent.parasite)}.`)]},{name:"muscle",title:"Can its muscle do it?",flight:{animal:"annas-hummingbird",model:"animal",speed:"slowest"},view:{camera:"front",arrows:!1},look:"gauges",tell:({now:n})=>[`Back ${si(n)}. Power per mass is ${Dp(Nh(n,"positive_power_per_mass"))}.`,"The bars show where the other numbers lie. Now drag the point yourself."]}]},Uh={animal:"bat",model:"paper",speed:"cheapest"},Hp={...Uh,model:"dickinson"},Vp={name:"coefficients",title:"A plate against a fruit fly",teaser:"The same bat in the same air; only the measured wing differs.",steps:[{name:"plate",title:"A bat on flat plates",flight:Uh,view:{camera:"oblique",arrows:!0},look:"picture",tell:({now:n})=>["What a wing feels in the air is measured once, on another wing, and then used for every strip.","Here it was a flat plate (Su et al. 2023).",`So the bat beats at ${En(n.frequency)} and needs ${ni(n.power)} ${si(n)}.`]},{name:"fly",title:"The same bat, a fruit fly's wing",flight:Hp,speedOf:"plate",view:{camera:"oblique",arrows:!0},pin:"plate",look:"picture",tell:({now:n,seen:t})=>["The coefficients now come from a model of a fruit fly's wing in oil (Dickinson et al. 1999).",...ci(t.plate,()=>"Animal and speed are the same; the ghost in the picture flies on plates."),...ci(t.plate,e=>`The frequency ${Ri(e.frequency,n.frequency,En)}.`),...ci(t.plate,e=>`Power ${Ri(e.power,n.power)}.`)]},{name:"fast",title:"Faster, on plates",flight:{...Uh,speed:"fastest"},view:{camera:"side",arrows:!0},look:"curve",tell:({now:n,seen:t})=>[`${Tn(si(n))}, on plates again, the bat needs ${ni(n.power)}.`,...ci(t.plate,e=>`The frequency ${Ri(e.frequency,n.frequency,En)}.`)]},{name:"fastFly",title:"Faster, with the fruit fly's wing",flight:{...Hp,speed:"fastest"},speedOf:"fast",view:{camera:"side",arrows:!0},pin:"fast",look:"curve",tell:({now:n,seen:t})=>[...ci(t.fast,e=>`With the fruit fly's coefficients, power ${Ri(e.power,n.power)} ${si(n)}.`),"Neither wing is a bat's. The two answers show how much a result depends on that choice."]}]};var Xp=[Gp,Vp,kp,zp],qp={slowest:n=>n[0].speed,fastest:n=>n.at(-1).speed,cheapest:n=>Wp(n).speed,slow:n=>yw(n,.75*n[0].speed+.25*Wp(n).speed).speed};function Wp(n){return n.reduce((t,e)=>e.power<t.power?e:t)}function yw(n,t){return n.reduce((e,i)=>Math.abs(i.speed-t)<Math.abs(e.speed-t)?i:e)}var vw=6,zl=class{constructor(t){this.face=t,this.calm=window.matchMedia("(prefers-reduced-motion: reduce)").matches,this.cards=Xp.map(i=>this.card(i));let e=R("ul",{},...this.cards.map(({element:i})=>i));this.element=R("section",{class:"wbx-tours"},R("h2",{},"Guided tours"),e),this.build()}card(t){let e=R("button",{type:"button",onclick:()=>this.start(t,e)},t.title),i=R("span");return{story:t,button:e,words:i,element:R("li",{},e,i)}}offer(){for(let{story:t,button:e,words:i}of this.cards)e.disabled=!t.steps.some(s=>this.flight(s)),i.textContent=e.disabled?"This page has no flight of this tour.":t.teaser}build(){let t=(i,s,r={})=>R("button",{type:"button",onclick:s,...r},i);this.count=R("p",{class:"wbx-note"}),this.title=R("h2",{tabindex:"-1"}),this.text=R("div",{class:"wbx-tour-text","aria-live":"polite"}),this.back=t("Back",()=>this.go(this.nth-1,-1)),this.again=t("Show this step again",()=>this.go(this.nth,1),{hidden:!0}),this.next=t("Next",()=>this.isLast?this.close():this.go(this.nth+1,1),{"data-go":"next"});let e=t("\xD7",()=>this.close(),{class:"wbx-close","aria-label":"Close the tour"});this.panel=R("section",{class:"wbx-tour","aria-label":"Guided tour",hidden:!0,onkeydown:i=>this.key(i)},R("div",{class:"wbx-row"},this.count,e),this.title,this.text,R("div",{class:"wbx-row"},this.back,this.again,this.next))}key(t){let e={ArrowRight:this.next,ArrowLeft:this.back}[t.key];if(t.key==="Escape")this.close();else if(e&&!e.disabled)e.click();else return;t.preventDefault(),t.stopPropagation()}start(t,e){Object.assign(this,{story:t,opener:e,seen:{}}),this.panel.hidden=!1,this.face.root.dataset.tour=t.name,this.title.focus({preventScroll:!0}),this.go(0,1)}close(){this.pin(void 0),this.panel.hidden=!0,this.step=void 0,delete this.face.root.dataset.tour,delete this.face.root.dataset.look,this.opener.focus()}flight({flight:t}){let e=t.speed==="pushed",i=[t.model].flat().find(s=>this.face.has({animal:t.animal,model:s,push:e}));return i&&{...t,model:i}}go(t,e){let{steps:i}=this.story,s=[],r=t;for(;i[r]&&!this.flight(i[r]);r+=e)s.push(i[r].title);let o=i.slice(r+1),a=!o.some(l=>this.flight(l));a&&s.push(...o.map(({title:l})=>l)),this.left=s.map(l=>`Left out, because this page has no such flight: \u201C${l}\u201D.`),Object.assign(this,{nth:r,step:i[r],ready:!1,tries:0,isLast:a}),this.count.textContent=`${this.story.title}: ${r+1} of ${i.length}`,this.title.textContent=this.step.title,this.back.disabled=!i.slice(0,r).some(l=>this.flight(l)),this.next.textContent=this.isLast?"Finish":"Next",this.again.hidden=!0,this.say(["Looking for this flight \u2026"]),this.ask()}heard(){this.step&&(this.ready?this.again.hidden=bw(this.face.answer,this.shown):this.ask())}heardCurve(){this.step&&this.waitsForCurve&&this.ask()}ask(){let{face:t,step:e}=this,{animal:i,model:s}=this.flight(e),{answer:r}=t;if(r?.species!==i||r.model!==s)return this.request({animal:i,model:s});let{pending:o=[],points:a}=t.curve.data;if(this.waitsForCurve=o.length>0,this.waitsForCurve)return this.say([`Computing the curve; ${o.length} more speeds to go.`]);let l=this.speed(a.filter(c=>c.certified));if(l!==void 0&&Math.abs(l-r.speed)>1e-9)return this.request({speed:l});if(e.push&&!r.scene?.pushes&&r.status==="converged")return this.say(["Flying through the gusts \u2026"]),t.onpush();this.arrive(r)}request(t){this.tries+=1,this.tries>vw?this.finish(["This page does not have the flight of this step."]):this.face.ask(t)}speed(t){let{step:e,seen:i,face:s}=this;return e.flight.speed==="pushed"?s.pushSpeed(s.answer):i[e.speedOf]?i[e.speedOf].speed:t.length?qp[e.flight.speed](t):void 0}arrive(t){let{step:e,seen:i}=this;if(this.ready=!0,t.status==="converged"&&(i[e.name]=t),this.pin(i[e.pin]),this.look(),t.status!=="converged")return this.finish([t.sentence]);let s=e.push&&this.push(t.scene.pushes);if(e.push&&!s)return this.finish(["No feedback was found that holds this flight."]);this.finish(e.tell({now:t,seen:i,push:s,semiSpan:t.scene.flights[0].semi_span}))}finish(t){this.ready=!0,this.shown=this.face.answer,this.say(t)}say(t){let e=this.left.map(i=>R("p",{class:"wbx-note"},i));this.text.replaceChildren(...e,...t.map(i=>R("p",{},...Ip(i))))}pin(t){let{pins:e}=this.face,i=this.pinned&&e.answer===this.pinned;t!==e.answer&&(t||i)&&e.pin(t),this.pinned=t}push(t){let{direction:e,feedback:i}=this.step.push,s=t.find(r=>r.direction===e&&r.feedback===i);return s&&this.face.viewer.pushes.choose(s),s}look(){let{viewer:t,root:e}=this.face,{camera:i,arrows:s}=this.step.view,r={resultant:s,lift:!1,drag:!1,trails:!0};t.setCamera(i);for(let o of t.root.querySelectorAll(".wb-toggle")){let a=o.querySelector("input"),l=r[o.textContent.trim()];l!==void 0&&a.checked!==l&&a.click()}e.dataset.look=this.step.look,this.scroll(e,e.querySelector(`[data-part="${this.step.look}"]`))}scroll(t,e){let i=this.calm?"auto":"smooth",s=this.panel.offsetWidth<window.innerWidth?0:this.panel.offsetHeight;e.getBoundingClientRect().bottom-t.getBoundingClientRect().top<=window.innerHeight-s?t.scrollIntoView({block:"start",behavior:i}):e.scrollIntoView({block:"nearest",behavior:i})}};function bw(n,t){return["species","model","speed"].every(e=>n[e]===t[e])}var ww={closes:["Closes","Does not close"],plausible:["Plausible","Not plausible"]},Mw=/(\d[\d.,]*(?:e[+-]?\d+)?(?: m\/s| W| times a second| times)?)/,Hl=class{constructor(){this.sentence=R("h1",{class:"wbx-sentence"}),this.lights=R("ul",{class:"wbx-lights","aria-label":"Verdict"}),this.summary=R("summary"),this.list=R("ul",{tabindex:"0","aria-label":"Warnings"}),this.warnings=R("details",{class:"wbx-warnings"},this.summary,this.list),this.warnings.open=window.matchMedia("(min-width: 900px)").matches,this.element=R("div",{class:"wbx-verdict"},this.lights,this.warnings),this.spoken=R("p",{class:"wbx-unseen",role:"status"})}show(t){let e=t.sentence.split(Mw);this.sentence.replaceChildren(...e.map((o,a)=>a%2?R("b",{},o):o)),this.speak(t.sentence),this.lights.replaceChildren(...t.lights.map(o=>this.light(o)));let{warnings:i}=t;this.warnings.classList.toggle("wbx-narrow",!i.length);let s=i.length===1?"1 warning":`${i.length} warnings`;this.summary.replaceChildren(R("span",{class:"wbx-narrow"},"Reasons, "),s);let r=t.lights.map(({text:o})=>R("li",{class:"wbx-narrow"},o));this.list.replaceChildren(...r,...i.map(o=>R("li",{},o)))}speak(t){clearTimeout(this.later),this.later=setTimeout(()=>this.spoken.textContent=t,700)}light({name:t,good:e,known:i,text:s}){let r=e?"good":i===!1?"open":"bad",o=r==="open"?"Plausible? Not known":ww[t][e?0:1],a=R("span",{class:"wbx-sign","aria-hidden":"true"},{good:"\u2713",bad:"!",open:"?"}[r]),l=R("span",{},R("strong",{},o)," ",R("span",{class:"wbx-why"},s));return R("li",{class:`wbx-light wbx-${r}`,"data-light":t},a,l)}};var Sw=0,zs=class{constructor(t,{theme:e="system",snap:i=!0}={}){this.onask=()=>{},this.onpush=void 0,this.onfile=void 0,this.theme=e,this.id=`wbx${++Sw}`,this.verdict=new Hl,this.curve=new Ll(s=>this.ask({speed:s}),i),this.gauges=new Dl,this.pins=new Fl(()=>this.show()),this.tour=new zl(this),this.own=new Ol(this),this.root=R("section",{class:"wbx","aria-label":"Explorer"},R("style",{},Rp+Ap)),this.root.face=this,this.build(),this.setTheme(e),t.append(this.root)}build(){this.animal=this.choice("Animal",r=>this.ask({animal:r})),this.model=this.choice("Model",r=>this.ask({model:r})),this.choices=R("div",{class:"wbx-choices"},this.animal.element,this.model.element),this.state=R("p",{class:"wbx-state",role:"status"}),this.picture=R("div",{class:"wbx-picture","data-part":"picture"}),this.pushButton=R("button",{type:"button",class:"wbx-push",hidden:!0,onclick:()=>this.push()}),this.numbers=R("tbody");let t=R("table",{},this.numbers),e=R("details",{class:"wbx-more"},R("summary",{},"More numbers"),t),i=[R("h2",{},"Could an animal fly so?"),this.gauges.element,this.pins.element,e],s=R("div",{class:"wbx-judged","data-part":"gauges"},...i);this.root.append(R("header",{class:"wbx-say"},this.choices,this.verdict.sentence,this.verdict.spoken),R("div",{class:"wbx-side"},this.verdict.element,s),R("div",{class:"wbx-stage"},this.picture,this.pushButton,this.state,this.curve.element),R("div",{class:"wbx-extras"},this.tour.element,this.own.element),this.tour.panel)}choice(t,e){let i=`${this.id}-${t}`,s=R("select",{id:i,onchange:()=>e(s.value)});return{select:s,element:R("span",{class:"wbx-choice"},R("label",{for:i},t),s)}}setChoices({animals:t,models:e},{animal:i,model:s}){this.asked={speed:this.asked?.speed,animal:i,model:s};for(let[{select:r},o,a]of[[this.animal,t,i],[this.model,e,s]])r.replaceChildren(...o.map(({name:l,title:c})=>R("option",{value:l},c))),r.value=a;this.tour.offer()}showCurve(t){this.curve.show(t),this.tour.heardCurve()}showAnswer(t){this.answer=t,this.asked={animal:t.species,model:t.model,speed:t.speed},this.animal.select.value=t.species,this.model.select.value=t.model,this.pins.now(t),this.say(""),this.show(),this.pushing&&this.pushSpeed(t)===t.speed&&this.push(),queueMicrotask(()=>this.tour.heard())}showPushes(t){let e=document.activeElement===this.pushButton;this.showAnswer({...this.answer,scene:{...this.answer.scene,pushes:t}}),e&&this.viewer.pushes.element.querySelector("select")?.focus()}say(t){this.state.textContent=t}setTheme(t){this.theme=t,this.root.dataset.theme=t,this.viewer?.setTheme(t)}has({animal:t,model:e,push:i}){let s=({select:r},o)=>[...r.options].some(a=>a.value===o);return s(this.animal,t)&&s(this.model,e)&&!(i&&!this.onpush)}pushSpeed(t){return this.onpush&&t.status==="converged"?t.speed:void 0}ask(t){this.asked={...this.asked,...t},this.onask({...this.asked})}push(){let t=this.pushSpeed(this.answer);this.pushing=t!==this.answer.speed,this.pushing?this.ask({speed:t}):this.onpush()}tellPush(){let{answer:t}=this,e=this.pushSpeed(t);if(this.pushButton.hidden=e===void 0||!!t.scene?.pushes,e===void 0)return;let i=e===t.speed?"":`, at ${me(e)} m/s`;this.pushButton.textContent=`Push it with a gust${i}`}show(){let{answer:t}=this;if(!t)return;let e=this.pins.answer;this.verdict.show(t),this.gauges.show(t.gauges,e?.gauges),this.curve.mark(t.speed),this.curve.pin(e?.status==="converged"?e:void 0),this.numbers.replaceChildren(...Ew(t,e)),this.root.dataset.status=t.status,this.picture.hidden=!t.scene,t.scene?this.fly(this.pins.scene(t),t.species):this.say("This flight tumbles before there is anything to show."),this.tellPush()}fly(t,e){let i=t.flights.length;this.viewer?this.replace(t,e===this.whose&&i===this.count):(this.viewer=new Bs(this.picture,t,{theme:this.theme,compact:!0}),this.own.overlay()),e!==this.whose&&this.viewer.setBeat(1),[this.whose,this.count]=[e,i]}replace(t,e){let{camera:i,controls:s}=this.viewer.stage,[r,o]=[i.position.clone(),s.target.clone()];this.viewer.ghost=this.pins.ghost,this.viewer.replace(t),e&&(i.position.copy(r),s.target.copy(o),s.update())}destroy(){this.own.destroy(),this.curve.destroy(),this.viewer?.destroy(),this.root.remove()}};function Ew(n,t){let e=new Map((t?.numbers??[]).map(([r,o])=>[r,o])),i=n.numbers.map(([r,o,a])=>{let l=[R("td",{},o),...t?[R("td",{},e.get(r)??"\u2013")]:[]];return R("tr",{},R("th",{scope:"row"},r),...l,R("td",{},a))});if(!t)return i;let s=["","now","pinned",""].map(r=>R("th",{scope:"col"},r));return[R("tr",{},...s),...i]}var Gl=class{constructor(t,e){this.catalogue=e,this.lattices=new Map,this.pushes=new Map;let i=this.fragment();this.asked={...e.start,...i.animal?{speed:void 0}:{},...i},this.face=new zs(t,{}),this.face.onask=s=>this.ask(s),this.face.onpush=()=>this.push(),this.face.has=({animal:s,model:r,push:o})=>e.files.includes(Yr(s,r,o)),this.face.pushSpeed=({species:s,model:r})=>this.pushSpeed(s,r),this.ask(this.asked)}fragment(){let t=new URLSearchParams(location.hash.slice(1)),e={};return this.catalogue.animals.some(({name:i})=>i===t.get("animal"))&&(e.animal=t.get("animal")),this.catalogue.models.some(({name:i})=>i===t.get("model"))&&(e.model=t.get("model")),Number.isFinite(parseFloat(t.get("speed")))&&(e.speed=parseFloat(t.get("speed"))),e}models(t){return this.catalogue.models.filter(({name:e})=>this.catalogue.files.includes(Yr(t,e)))}ask(t){let e=this.models(t.animal),i=e.some(({name:r})=>r===t.model)?t.model:e[0].name,s=t.animal===this.asked.animal?t.speed:void 0;this.asked={...t,model:i,speed:s},this.listed!==t.animal&&this.face.setChoices({animals:this.catalogue.animals,models:e},this.asked),this.listed=t.animal,this.load()}load(){let{asked:t}=this,e=`${t.animal}/${t.model}`;if(this.lattices.has(e))return this.show(this.lattices.get(e));this.face.say("Loading \u2026"),this.read(Yr(t.animal,t.model))}read(t){let e=()=>this.face.say(`The file data/${t} could not be read.`);document.head.append(R("script",{src:`data/${t}`,onerror:e}))}async hold(t,e,i){let s=await $p(i);for(let{gauges:r}of s.answers)for(let o of r)o.source??=s.sources[o.name];this.lattices.set(`${t}/${e}`,s),this.asked.animal===t&&this.asked.model===e&&this.show(s)}pushSpeed(t,e){let i=this.lattices.get(`${t}/${e}`);return this.catalogue.files.includes(Yr(t,e,!0))?i?.speed:void 0}push(){let{animal:t,model:e}=this.asked,i=this.pushes.get(`${t}/${e}`);if(i)return this.face.showPushes(i);this.face.say("Loading the gusts \u2026"),this.read(Yr(t,e,!0))}async holdPushes(t,e,i){let s=await $p(i);this.pushes.set(`${t}/${e}`,s);let{asked:r}=this;r.animal===t&&r.model===e&&r.speed===this.pushSpeed(t,e)&&this.face.showPushes(s)}show(t){let e=({speed:o})=>Math.abs(o-(this.asked.speed??t.speed)),i=t.answers.reduce((o,a)=>e(a)<e(o)?a:o);this.shown!==t&&this.face.showCurve(t.curve),this.shown=t;let{animal:s,model:r}=this.asked;this.asked.speed=i.speed,this.face.showAnswer(i),history.replaceState(null,"",`#${new URLSearchParams({animal:s,model:r,speed:i.speed})}`)}};async function $p(n){let t=Uint8Array.from(atob(n),i=>i.charCodeAt(0)),e=new Blob([t]).stream().pipeThrough(new DecompressionStream("gzip"));return JSON.parse(await new Response(e).text())}function Yr(n,t,e=!1){return`${n}-${t}${e?"-pushes":""}.js`}var Oh;globalThis.wingbeatExplorer={explore:(n,t={})=>new zs(n,t),mount:(n,t,e={})=>new Bs(n,t,e),open:n=>Oh=new Gl(document.querySelector("main"),n),hold:(n,t,e)=>Oh.hold(n,t,e),holdPushes:(n,t,e)=>Oh.holdPushes(n,t,e)};})();
